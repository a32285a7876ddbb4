// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-localize/localize_config.h"

#include <algorithm>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

const std::vector<std::string> kSensorWords = {"odometry", "imu", "gps", "beacons", "laser"};

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> out;
  std::stringstream in(list);
  for (std::string word; std::getline(in, word, ',');) out.push_back(word);
  return out;
}

void checkSensors(const std::vector<std::string>& sensors, const std::string& where) {
  for (const auto& s : sensors) {
    if (std::find(kSensorWords.begin(), kSensorWords.end(), s) != kSensorWords.end()) continue;
    const auto near = nearestWord(s, kSensorWords);
    throw ConfigError(where + ": '" + s + "' is no sensor, allowed odometry, imu, gps, beacons, laser" +
                      (near.empty() ? "" : "; did you mean '" + near + "'?"));
  }
}

void setInitialPose(const std::string& text, StartParams& start) {
  const auto words = split(text);
  try {
    if (words.size() != 3) throw std::invalid_argument("");
    double values[3];
    for (size_t i = 0; i < 3; ++i) {
      size_t used = 0;
      values[i] = std::stod(words[i], &used);
      if (used != words[i].size() || !std::isfinite(values[i])) throw std::invalid_argument("");
    }
    start.pose_given = true;
    start.x_m = values[0];
    start.y_m = values[1];
    start.yaw = values[2] * M_PI / 180;
  } catch (const std::exception&) {
    throw ConfigError("--initial-pose " + text + ": give three numbers x,y,deg");
  }
}

}  // namespace

void LocalizeConfig::visit(ParamVisitor& v) {
  v.choice("filter", filter, {"ekf", "pf", "mcl", "odometry"}, "the estimator");
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

LocalizeConfig effectiveConfig(const LocalizeOptions& o) {
  LocalizeConfig c;
  if (!o.config_file.empty()) readYaml(o.config_file, [&](ParamVisitor& v) { c.visit(v); });
  if (!o.filter.empty()) c.filter = o.filter;
  if (!o.align.empty()) c.align = o.align;
  if (o.seed) c.seed = *o.seed;
  if (!o.map.empty()) c.map = o.map;
  if (!o.sensors.empty()) c.sensors = split(o.sensors);
  if (c.filter == "odometry") c.sensors = {"odometry"};
  checkSensors(c.sensors, o.sensors.empty() ? o.config_file + ": sensors" : "--sensors");
  if (!o.initial_pose.empty()) setInitialPose(o.initial_pose, c.robot.start);
  c.robot.odometry.check();
  if (c.filter == "mcl" && c.map.empty())
    throw ConfigError("--filter mcl needs a map: give --map FILE, or map: FILE in the configuration");
  if (c.filter != "mcl" && std::find(c.sensors.begin(), c.sensors.end(), "laser") != c.sensors.end())
    throw ConfigError("--sensors laser: only --filter mcl uses a laser, in a map");
  if (c.uses("beacons") && c.robot.beacons.beacons.empty())
    throw ConfigError("--sensors beacons: the configuration names no beacons; list them under beacons.beacons");
  return c;
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
    out[kind] = w.substr(eq + 1);
  }
  return out;
}

}  // namespace sidestep
