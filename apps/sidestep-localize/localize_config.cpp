// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-localize/localize_config.h"

#include <cmath>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> out;
  std::stringstream in(list);
  for (std::string word; std::getline(in, word, ',');) out.push_back(word);
  return out;
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

LocalizeConfig effectiveConfig(const LocalizeOptions& o) {
  LocalizeConfig c;
  if (!o.config_file.empty()) readYaml(o.config_file, [&](ParamVisitor& v) { c.visit(v); });
  if (!o.filter.empty()) c.filter = o.filter;
  if (o.smooth) c.smooth = true;
  if (!o.align.empty()) c.align = o.align;
  if (o.seed) c.seed = *o.seed;
  if (!o.map.empty()) c.map = o.map;
  if (!o.sensors.empty()) c.sensors = split(o.sensors);
  if (!o.initial_pose.empty()) setInitialPose(o.initial_pose, c.robot.start);
  c.check(o.sensors.empty() ? o.config_file + ": sensors" : "--sensors");
  return c;
}

}  // namespace sidestep
