// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/configuration.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <algorithm>

#include "core/errors.h"
#include "datasets/log_reader.h"

namespace sidestep {
namespace {

const std::vector<std::string> kSensorWords = {"odometry", "imu", "gps", "beacons", "laser"};

void checkSensors(const std::vector<std::string>& sensors, const std::string& where) {
  for (const auto& s : sensors) {
    if (std::find(kSensorWords.begin(), kSensorWords.end(), s) != kSensorWords.end()) continue;
    const auto near = nearestWord(s, kSensorWords);
    throw ConfigError(where + ": '" + s + "' is no sensor, allowed odometry, imu, gps, beacons, laser" +
                      (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

}  // namespace

void LocalizeConfig::visit(ParamVisitor& v) {
  v.choice("filter", filter, {"ekf", "pf", "mcl", "odometry"}, "the estimator");
  v.flag("smooth", smooth, "estimates by the whole log (Rauch-Tung-Striebel), not only by what came before; ekf only");
  v.integer("seed", seed, {0, 2e9}, "of the random numbers, for filters that draw any");
  v.texts("sensors", sensors, "of odometry, imu, gps, beacons, laser; empty: those that the log has");
  v.choice("align", align, {"auto", "none", "first", "se2"},
           "how the estimate is laid onto the truth before errors are taken; auto: none where both frames are known");
  v.section("ground_truth", "the truth's frame, as a pose in the map", [this](ParamVisitor& w) {
    w.flag("frame_given", truth_frame_given, "the pose below is known");
    w.number("x_m", truth_x_m, {-1e7, 1e7}, "m", "its origin");
    w.number("y_m", truth_y_m, {-1e7, 1e7}, "m", "its origin");
    w.angle("yaw_deg", truth_yaw, {-360, 360}, "its turn");
  });
  v.section("ekf", "extended Kalman filter (section 3.1)", [this](ParamVisitor& w) { ekf.visit(w); });
  v.section("pf", "particle filter (section 3.2)", [this](ParamVisitor& w) { pf.visit(w); });
  v.section("mcl", "Monte Carlo localization in a map", [this](ParamVisitor& w) { mcl.visit(w); });
  v.text("map", map, "for mcl: ROS map.yaml, .gridmap(.gz), .simplemap(.gz), or an image");
  v.section("map_read", "what some maps do not say themselves", [this](ParamVisitor& w) { map_read.visit(w); });
  robot.visit(v);
}

bool LocalizeConfig::uses(const std::string& sensor) const {
  if (sensor == "laser" && filter != "mcl") return false;
  if (!sensors.empty()) return std::find(sensors.begin(), sensors.end(), sensor) != sensors.end();
  return sensor != "beacons" || !robot.beacons.beacons.empty();
}

Expectation LocalizeConfig::expectation() const {
  const double offset_sd = filter == "pf"    ? pf.heading_offset_sd
                           : filter == "mcl" ? mcl.engine.heading_offset_sd
                                             : ekf.heading_offset_sd;
  return {expectsFixes(), uses("imu") && robot.imu.heading != "off", offset_sd};
}

std::optional<double> LocalizeConfig::gateProbability() const {
  if (filter == "ekf") return ekf.gate ? ekf.gate_probability : 1;
  if (filter == "pf") return pf.likelihood == "gaussian" ? pf.gate_probability : 1;
  return std::nullopt;
}

void LocalizeConfig::check(const std::string& where) const {
  checkSensors(sensors, where);
  robot.odometry.check();
  if (smooth && (filter == "pf" || filter == "mcl"))
    throw ConfigError("smooth: = true, but only the ekf can be smoothed; take --filter ekf, or leave it out");
  if (filter == "mcl" && map.empty())
    throw ConfigError("--filter mcl needs a map: give --map FILE, or map: FILE in the configuration");
  if (filter != "mcl" && std::find(sensors.begin(), sensors.end(), "laser") != sensors.end())
    throw ConfigError("--sensors laser: only --filter mcl uses a laser, in a map");
  if (uses("beacons") && robot.beacons.beacons.empty())
    throw ConfigError("--sensors beacons: the configuration names no beacons; list them under beacons.beacons");
}

std::unique_ptr<PoseFilter> makeFilter(const LocalizeConfig& config, uint64_t seed) {
  if (config.filter == "mcl") {
    const auto model = std::make_shared<ScanModel>(readMap(config.map, config.map_read), config.mcl.scan);
    const bool global = !config.robot.start.pose_given && !config.expectsFixes();
    return makeMcl(config.mcl, seed, model, global);
  }
  if (config.filter == "pf") return makeParticleFilter(config.pf, seed);
  return makeEkf(config.ekf);
}

int LocalizationFeed::streamOf(const Reading& e) {
  const auto it = streams_.find(e.label);
  if (it != streams_.end()) return it->second;
  kinds_[e.label] = e.kind;
  return streams_[e.label] = localizer_.addStream(e.label);
}

void LocalizationFeed::feed(const Reading& e) {
  using namespace mrpt::obs;
  if (!config_.uses(word(e.kind))) return;
  if (e.kind == SensorKind::kOdometry) {
    localizer_.odometry(streamOf(e), e.time_s, dynamic_cast<const CObservationOdometry&>(*e.observation));
  } else if (e.kind == SensorKind::kImu) {
    localizer_.imu(streamOf(e), e.time_s, dynamic_cast<const CObservationIMU&>(*e.observation));
  } else if (e.kind == SensorKind::kBeacons) {
    localizer_.beacons(streamOf(e), e.time_s, dynamic_cast<const CObservationBeaconRanges&>(*e.observation));
  } else if (e.kind == SensorKind::kLaser) {
    if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(e.observation.get()))
      localizer_.laser(streamOf(e), e.time_s, *scan);
  } else if (e.kind == SensorKind::kGps) {
    if (const auto* gps = dynamic_cast<const CObservationGPS*>(e.observation.get()))
      localizer_.gps(streamOf(e), e.time_s, *gps);
    else if (const auto* pose = dynamic_cast<const CObservationRobotPose*>(e.observation.get()))
      localizer_.position(streamOf(e), e.time_s, pose->pose.mean.x(), pose->pose.mean.y());
  }
}

std::map<std::string, std::string> labelMap(const std::vector<std::string>& words) {
  static const std::vector<std::string> kinds = {"odometry", "imu",  "gps",          "beacons", "landmarks",
                                                 "laser",    "rgbd", "ground_truth", "estimate"};
  std::map<std::string, std::string> out;
  for (const auto& w : words) {
    const auto eq = w.find('=');
    if (eq == std::string::npos || eq + 1 == w.size())
      throw ConfigError("--label " + w + ": write it as kind=label, for example gps=GPS_RTK_REAR");
    const auto kind = w.substr(0, eq);
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
      const auto near = nearestWord(kind, kinds);
      throw ConfigError("--label " + w + ": '" + kind + "' is no kind of sensor" +
                        (near.empty() ? "" : "; did you mean '" + near + "'?"));
    }
    if (!out.emplace(kind, w.substr(eq + 1)).second)
      throw ConfigError("--label " + w + ": " + kind + " is given twice");
  }
  return out;
}

}  // namespace sidestep
