// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/odometry.h"

#include <mrpt/obs/CObservationOdometry.h>

namespace sidestep {
namespace {

class OdometrySensor final : public SensorModel {
 public:
  void interpret(const Reading& r, SensorSays& out) override {
    out.wheels = std::dynamic_pointer_cast<const mrpt::obs::CObservationOdometry>(r.observation);
    if (!out.wheels) out.refused = "no_increment";
  }
};

}  // namespace

std::unique_ptr<SensorModel> makeOdometrySensor(const OdometryParams&) { return std::make_unique<OdometrySensor>(); }

}  // namespace sidestep
