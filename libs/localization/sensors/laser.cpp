// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/laser.h"

#include <mrpt/obs/CObservation2DRangeScan.h>

namespace sidestep {
namespace {

class LaserSensor final : public SensorModel {
 public:
  explicit LaserSensor(const ScanParams& params) : params_(params) {}
  void interpret(const Reading& r, SensorSays& out) override {
    const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(r.observation.get());
    Measurement m;
    m.kind = Measurement::Kind::kScan;
    m.time_s = r.time_s - params_.delay_s;
    if (scan != nullptr) m.scan = readScan(params_, *scan);
    if (m.scan)
      out.measurements.push_back(m);
    else
      out.refused = "no_range";
  }

 private:
  ScanParams params_;
};

}  // namespace

std::unique_ptr<SensorModel> makeLaserSensor(const ScanParams& params) { return std::make_unique<LaserSensor>(params); }

}  // namespace sidestep
