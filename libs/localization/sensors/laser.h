// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "localization/sensors/scan.h"
#include "localization/sensors/sensor_model.h"

namespace sidestep {

std::unique_ptr<SensorModel> makeLaserSensor(const ScanParams& params);

}  // namespace sidestep
