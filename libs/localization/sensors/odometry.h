// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "localization/sensors/odometry_model.h"
#include "localization/sensors/sensor_model.h"

namespace sidestep {

/// Hands the wheels' readings on: MotionSource puts them together with the gyro.
std::unique_ptr<SensorModel> makeOdometrySensor(const OdometryParams& params);

}  // namespace sidestep
