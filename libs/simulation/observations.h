// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <functional>

#include "simulation/localization_scenario.h"

namespace sidestep {

/// Unix time at which simulated runs begin [s]: no clock is read, so that the same run gives the same bytes.
inline constexpr double kSimulationStart_s = 1.6e9;

using ObservationSink = std::function<void(const mrpt::obs::CObservation&)>;

/// What a step of a scenario is in a rawlog: `odometry`, `imu`, `gps`, `ground_truth`, in this order.
void tellObservations(const SensorStep& step, const EncoderParams& encoders, const GpsErrorParams& gps,
                      const ObservationSink& sink);

}  // namespace sidestep
