// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "core/params.h"
#include "localization/sensors/sensor_model.h"

namespace sidestep {

/// Ranges to known beacons, the indoor stand-in for GPS.
struct BeaconParams {
  double sd_m = 0.2;
  double delay_s = 0;
  Table beacons;  // id, x, y, z

  void visit(ParamVisitor& v);
};

/// One measurement a range to a beacon that the parameters know.
std::unique_ptr<SensorModel> makeBeaconSensor(const BeaconParams& params);

}  // namespace sidestep
