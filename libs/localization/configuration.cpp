// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/configuration.h"

#include <mrpt/poses/CPose2D.h>

#include <algorithm>

#include "core/errors.h"
#include "localization/pose_filter.h"
#include "localization/sensors/odometry.h"
#include "localization/sensors/sensors.h"

namespace sidestep {
namespace {

bool isNamed(const std::vector<std::string>& sensors, SensorKind kind) {
  return std::find(sensors.begin(), sensors.end(), word(kind)) != sensors.end();
}

std::string lackOf(const SensorRow& row, const LocalizerParams& robot) {
  return row.lacks ? row.lacks(robot.sensors) : "";
}

}  // namespace

void LocalizeConfig::visit(ParamVisitor& v) {
  v.choice("filter", filter, filterNames(), "the estimator");
  v.flag("smooth", smooth, "estimates by the whole log (Rauch-Tung-Striebel), not only by what came before; ekf only");
  v.integer("seed", seed, {0, 2e9}, "of the random numbers, for filters that draw any");
  v.texts("sensors", sensors, "of " + sensorWords() + "; empty: those that the log has");
  v.choice("align", align, {"auto", "none", "first", "se2"},
           "how the estimate is laid onto the truth before errors are taken; auto: none where both frames are known");
  v.section("ground_truth", "the truth's frame, as a pose in the map", [this](ParamVisitor& w) {
    w.flag("frame_given", truth_frame_given, "the pose below is known");
    w.number("x_m", truth_x_m, {-1e7, 1e7}, "m", "its origin");
    w.number("y_m", truth_y_m, {-1e7, 1e7}, "m", "its origin");
    w.angle("yaw_deg", truth_yaw, {-360, 360}, "its turn");
  });
  filters.visit(v);
  v.text("map", map, "for mcl: ROS map.yaml, .gridmap(.gz), .simplemap(.gz), or an image");
  v.section("map_read", "what some maps do not say themselves", [this](ParamVisitor& w) { map_read.visit(w); });
  robot.visit(v);
}

bool LocalizeConfig::uses(SensorKind kind) const {
  const SensorRow* sensor = sensorOf(kind);
  if (sensor == nullptr || (sensor->needs_map && !row().needs_map)) return false;
  if (row().odometry_only) return kind == SensorKind::kOdometry;
  if (!sensors.empty()) return isNamed(sensors, kind);
  return lackOf(*sensor, robot).empty();
}

std::vector<SensorKind> LocalizeConfig::usedKinds() const {
  std::vector<SensorKind> out;
  for (const auto& sensor : sidestep::sensors())
    if (uses(sensor.kind)) out.push_back(sensor.kind);
  return out;
}

LocalizerSetup LocalizeConfig::setup() const {
  LocalizerSetup out;
  out.sensors = usedKinds();
  // Fixes tell where the robot starts; a filter with a map need not wait for them unless they are asked for by name.
  for (const auto kind : out.sensors) {
    const auto& sensor = *sensorOf(kind);
    if (sensor.frame == SensorFrame::kGeodetic && (!row().needs_map || !sensors.empty())) out.start.positions = true;
    if (sensor.tells_heading && sensor.tells_heading(robot.sensors)) out.start.heading = true;
  }
  out.start.heading_offset_sd = row().heading_offset_sd(filters);
  out.joins_instants = row().joins_instants && row().joins_instants(filters);
  return out;
}

std::optional<double> LocalizeConfig::gateProbability() const {
  return row().gate_probability ? row().gate_probability(filters) : std::nullopt;
}

mrpt::math::TPose2D LocalizeConfig::truthInMap(const mrpt::math::TPose2D& truth) const {
  if (!truth_frame_given) return truth;
  const mrpt::poses::CPose2D T_map_truth(truth_x_m, truth_y_m, truth_yaw);
  return (T_map_truth + mrpt::poses::CPose2D(truth)).asTPose();
}

void LocalizeConfig::check(const std::string& where) const {
  checkSensorWords(sensors, where);
  robot.of<OdometryParams>().check();
  if (smooth && !row().can_smooth)
    throw ConfigError("smooth: = true, but only the ekf can be smoothed; take --filter ekf, or leave it out");
  if (row().needs_map && map.empty())
    throw ConfigError("--filter " + filter + " needs a map: give --map FILE, or map: FILE in the configuration");
  for (const auto& sensor : sidestep::sensors()) {
    const std::string name = word(sensor.kind);
    if (!isNamed(sensors, sensor.kind)) continue;
    if (sensor.needs_map && !row().needs_map)
      throw ConfigError("--sensors " + name + ": only --filter " + filtersWith(&FilterRow::needs_map) + " uses a " +
                        name + ", in a map");
    if (const auto lack = lackOf(sensor, robot); !lack.empty()) throw ConfigError("--sensors " + name + ": " + lack);
  }
}

Localizer makeLocalizer(const LocalizeConfig& config, uint64_t seed) {
  const auto setup = config.setup();
  std::optional<GridMap> map;
  FilterInputs inputs{seed, nullptr, !config.robot.start.pose_given && !setup.start.positions};
  if (config.row().needs_map) inputs.map = &map.emplace(readMap(config.map, config.map_read));
  Localizer localizer(config.robot, config.row().make(config.filters, inputs), setup);
  if (config.smooth) localizer.smoothAtEnd();
  return localizer;
}

bool wasUsed(const std::vector<SensorUse>& sensors, SensorKind kind) {
  return std::any_of(sensors.begin(), sensors.end(), [&](const SensorUse& s) { return s.kind == kind && s.used > 0; });
}

std::string usedLabels(const std::vector<SensorUse>& sensors) {
  std::vector<std::string> labels;
  for (const auto& s : sensors) labels.push_back(s.label);
  std::sort(labels.begin(), labels.end());
  std::string out;
  for (const auto& label : labels) out += (out.empty() ? "" : ", ") + label;
  return out.empty() ? "nothing" : out;
}

void requireSensors(const LocalizeConfig& config, const std::vector<SensorUse>& sensors, const std::string& log) {
  for (const auto& sensor : sidestep::sensors())
    if (isNamed(config.sensors, sensor.kind) && config.uses(sensor.kind) && !wasUsed(sensors, sensor.kind))
      throw DatasetError::missing(log + ": nothing of sensor '" + word(sensor.kind) + "' was usable (used: " +
                                  usedLabels(sensors) + "); see sidestep-rawlog info, and --label");
}

}  // namespace sidestep
