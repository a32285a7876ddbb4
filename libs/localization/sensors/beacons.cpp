// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/beacons.h"

#include <mrpt/obs/CObservationBeaconRanges.h>

namespace sidestep {
namespace {

class BeaconSensor final : public SensorModel {
 public:
  explicit BeaconSensor(const BeaconParams& params) : params_(params) {}
  void interpret(const Reading& r, SensorSays& out) override {
    const auto* ranges = dynamic_cast<const mrpt::obs::CObservationBeaconRanges*>(r.observation.get());
    if (ranges != nullptr) collect(r.time_s, *ranges, out.measurements);
    if (out.measurements.empty())
      out.refused = "unknown_beacon";
    else
      out.read = out.measurements.size();
  }

 private:
  void collect(double time_s, const mrpt::obs::CObservationBeaconRanges& ranges, std::vector<Measurement>& out) const {
    for (const auto& range : ranges.sensedData)
      for (const auto& beacon : params_.beacons)
        if (static_cast<int>(beacon[0]) == range.beaconID) out.push_back(measurement(time_s, range, beacon));
  }
  template <class Range>
  Measurement measurement(double time_s, const Range& range, const std::vector<double>& beacon) const {
    Measurement m;
    m.kind = Measurement::Kind::kRange;
    m.time_s = time_s - params_.delay_s;
    m.z(0) = static_cast<double>(range.sensedDistance);
    m.R(0, 0) = params_.sd_m * params_.sd_m;
    const auto& p = range.sensorLocationOnRobot;
    m.p_base_sensor << p.x(), p.y(), p.z();
    m.p_map_beacon << beacon[1], beacon[2], beacon[3];
    return m;
  }

  BeaconParams params_;
};

}  // namespace

void BeaconParams::visit(ParamVisitor& v) {
  v.number("sd_m", sd_m, {0.001, 100}, "m", "sd of a range");
  v.number("delay_s", delay_s, {-10, 10}, "s", "how late ranges are stamped");
  v.table("beacons", {"id", "x", "y", "z"}, beacons, "where the beacons are, in the map [m]");
}

std::unique_ptr<SensorModel> makeBeaconSensor(const BeaconParams& params) {
  return std::make_unique<BeaconSensor>(params);
}

}  // namespace sidestep
