// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <functional>

#include "simulation/epoch.h"
#include "simulation/localization_scenario.h"

namespace sidestep {

using ObservationSink = std::function<void(const mrpt::obs::CObservation&)>;

/// What a step of a scenario is in a rawlog: `odometry`, `imu`, `gps`, `ground_truth`, in this order.
void tellObservations(const SensorStep& step, const EncoderParams& encoders, const GpsErrorParams& gps,
                      const ObservationSink& sink);

}  // namespace sidestep
