// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/sensors.h"

#include <algorithm>

#include "core/errors.h"
#include "localization/sensors/beacons.h"
#include "localization/sensors/gps.h"
#include "localization/sensors/imu.h"
#include "localization/sensors/laser.h"
#include "localization/sensors/odometry.h"

namespace sidestep {
namespace {

const ParamSection kOdometry = paramSection<OdometryParams>("odometry", "wheels");
const ParamSection kImu = paramSection<ImuParams>("imu", "inertial unit");
const ParamSection kGps = paramSection<GpsParams>("gps", "satellite positioning");
const ParamSection kBeacons = paramSection<BeaconParams>("beacons", "ranges to known beacons");
const ParamSection kLaser = paramSection<ScanParams>("laser", "laser scans, for mcl");

template <class Params, std::unique_ptr<SensorModel> (*make)(const Params&)>
std::unique_ptr<SensorModel> from(const ParamSections& p) {
  return make(p.of<Params>());
}

bool imuTellsHeading(const ParamSections& p) { return p.of<ImuParams>().heading != "off"; }

std::string beaconsLack(const ParamSections& p) {
  return p.of<BeaconParams>().beacons.empty() ? "the configuration names no beacons; list them under beacons.beacons"
                                              : "";
}

std::vector<std::string> words() {
  std::vector<std::string> out;
  for (const auto& row : sensors()) out.push_back(word(row.kind));
  return out;
}

}  // namespace

const std::vector<SensorRow>& sensors() {
  using enum SensorFrame;
  static const std::vector<SensorRow> kRows = {
      {SensorKind::kOdometry, "wheel odometry: poses, velocities or encoder ticks", &kOdometry, kNone, false, nullptr,
       nullptr, from<OdometryParams, makeOdometrySensor>},
      {SensorKind::kImu, "inertial unit: heading (3.12) and turn rate", &kImu, kNone, false, imuTellsHeading, nullptr,
       from<ImuParams, makeImuSensor>},
      {SensorKind::kGps, "satellite positioning, or any position fix (3.10)", &kGps, kGeodetic, false, nullptr, nullptr,
       from<GpsParams, makeGpsSensor>},
      {SensorKind::kBeacons, "ranges to known beacons", &kBeacons, kSurveyed, false, nullptr, beaconsLack,
       from<BeaconParams, makeBeaconSensor>},
      {SensorKind::kLaser, "laser scans, in a map", &kLaser, kMap, true, nullptr, nullptr,
       from<ScanParams, makeLaserSensor>},
  };
  return kRows;
}

const SensorRow* sensorOf(SensorKind kind) {
  const auto& rows = sensors();
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const SensorRow& r) { return r.kind == kind; });
  return it == rows.end() ? nullptr : &*it;
}

std::string sensorWords(const std::string& separator) {
  std::string out;
  for (const auto& w : words()) out += (out.empty() ? "" : separator) + w;
  return out;
}

ParamSections sensorParams() {
  std::vector<const ParamSection*> sections;
  for (const auto& row : sensors()) sections.push_back(row.section);
  return ParamSections(sections);
}

void checkSensorWords(const std::vector<std::string>& given, const std::string& where) {
  const auto known = words();
  for (const auto& w : given) {
    if (std::find(known.begin(), known.end(), w) != known.end()) continue;
    const auto near = nearestWord(w, known);
    throw ConfigError(where + ": '" + w + "' is no sensor, allowed " + sensorWords() +
                      (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

}  // namespace sidestep
