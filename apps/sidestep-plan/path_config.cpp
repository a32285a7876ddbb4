// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-plan/path_config.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> out;
  std::stringstream in(line);
  for (std::string word; std::getline(in, word, ',');) {
    const auto first = word.find_first_not_of(" \t\r"), last = word.find_last_not_of(" \t\r");
    out.push_back(first == std::string::npos ? "" : word.substr(first, last - first + 1));
  }
  return out;
}

std::optional<double> toNumber(const std::string& word) {
  try {
    size_t used = 0;
    const double value = std::stod(word, &used);
    if (used == word.size() && std::isfinite(value)) return value;
  } catch (const std::exception&) {
  }
  return std::nullopt;
}

mrpt::math::TPose2D toPose(const std::string& option, const std::string& text) {
  const auto words = split(text);
  double values[3] = {0, 0, 0};
  for (size_t i = 0; i < words.size() && words.size() <= 3; ++i) {
    const auto value = toNumber(words[i]);
    if (!value) throw ConfigError(option + " " + text + ": give numbers x,y,deg");
    values[i] = *value;
  }
  if (words.size() != 2 && words.size() != 3) throw ConfigError(option + " " + text + ": give numbers x,y,deg");
  return {values[0], values[1], values[2] * M_PI / 180};
}

/// Corners x,y,x,y,... of a robot's outline.
Table toFootprint(const std::string& text) {
  const auto words = split(text);
  Table out;
  for (size_t i = 0; i + 1 < words.size(); i += 2) {
    const auto x = toNumber(words[i]), y = toNumber(words[i + 1]);
    if (!x || !y) break;
    out.push_back({*x, *y});
  }
  if (words.size() < 6 || out.size() * 2 != words.size())
    throw ConfigError("--footprint " + text + ": give the corners x,y,x,y,x,y of three or more");
  return out;
}

/// Room for the whole outline, whichever way the robot looks: the distance of its farthest corner.
void widenForFootprint(PathConfig& c) {
  if (c.footprint.empty()) return;
  if (c.footprint.size() < 3) throw ConfigError("footprint: has fewer than three corners");
  for (const auto& corner : c.footprint)
    c.planning.clearance_m = std::max(c.planning.clearance_m, std::hypot(corner[0], corner[1]));
}

/// Which column is which, by name.
struct Columns {
  size_t start_x = 0, start_y = 0, goal_x = 0, goal_y = 0;

  Columns(const std::string& file, const std::string& header) {
    const auto words = split(header);
    const auto find = [&](const std::string& name) {
      for (size_t i = 0; i < words.size(); ++i)
        if (words[i] == name) return i;
      const auto near = nearestWord(name, words);
      throw DatasetError::corrupt(file + ":1: lacks the column " + name +
                                  (near.empty() ? "" : " (is '" + near + "' meant?)"));
    };
    start_x = find("start_x"), start_y = find("start_y"), goal_x = find("goal_x"), goal_y = find("goal_y");
  }
};

std::vector<PathPair> readPairsFile(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  if (!in) throw DatasetError::missing(file + ": pairs cannot be read; check the name");
  if (!std::getline(in, line)) throw DatasetError::corrupt(file + ": is empty; its first line must name the columns");
  const Columns columns(file, line);
  std::vector<PathPair> out;
  for (size_t number = 2; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const auto words = split(line);
    const auto value = [&](size_t column) {
      const auto v = column < words.size() ? toNumber(words[column]) : std::nullopt;
      if (!v)
        throw DatasetError::corrupt(file + ":" + std::to_string(number) + ": column " + std::to_string(column + 1) +
                                    " is no number");
      return *v;
    };
    out.push_back(
        {{value(columns.start_x), value(columns.start_y), 0}, {value(columns.goal_x), value(columns.goal_y), 0}});
  }
  if (out.empty()) throw DatasetError::corrupt(file + ": holds no pairs");
  return out;
}

}  // namespace

void PathConfig::visit(ParamVisitor& v) {
  v.choice("planner", planner, globalPlanners(), "of the path");
  v.flag("smooth", smooth, "round the path off (not arcs)");
  v.table("footprint", {"x", "y"}, footprint,
          "corners of the robot in its base frame; then the clearance is at least what its farthest corner needs");
  v.number("nearest_within_m", nearest_within_m, {0, 1000}, "m",
           "how far start and goal may be moved if that is asked for");
  v.section("map", "what some map files do not say", [this](ParamVisitor& w) { map.visit(w); });
  v.section("obstacles", "which cells block", [this](ParamVisitor& w) { obstacles.visit(w); });
  v.section("field", "the distance field", [this](ParamVisitor& w) { field.visit(w); });
  v.section("planning", "of global paths (section 4.4.1 c)", [this](ParamVisitor& w) { planning.visit(w); });
  v.section("smoothing", "rounding a path off", [this](ParamVisitor& w) { smoothing.visit(w); });
}

PathConfig effectivePathConfig(const PathOptions& o) {
  PathConfig c;
  if (!o.config_file.empty()) readYaml(o.config_file, [&](ParamVisitor& v) { c.visit(v); });
  if (!o.planner.empty()) c.planner = o.planner;
  if (!o.space.empty()) c.planning.sampling.space = o.space;
  if (o.clearance_m) c.planning.clearance_m = *o.clearance_m;
  if (o.resolution_m) c.map.image_resolution_m = *o.resolution_m;
  if (o.time_s) c.planning.sampling.time_s = *o.time_s;
  if (o.seed) c.planning.sampling.seed = *o.seed;
  if (o.smooth) c.smooth = true;
  if (!o.footprint.empty()) c.footprint = toFootprint(o.footprint);
  widenForFootprint(c);
  return c;
}

std::vector<PathPair> readPairs(const PathOptions& o) {
  const bool one = !o.start.empty() || !o.goal.empty();
  if (one && !o.pairs_file.empty()) throw ConfigError("--pairs and --start, --goal exclude each other");
  if (!o.pairs_file.empty()) return readPairsFile(o.pairs_file);
  if (o.start.empty() || o.goal.empty()) throw ConfigError("give --start x,y,deg and --goal x,y,deg, or --pairs FILE");
  return {{toPose("--start", o.start), toPose("--goal", o.goal)}};
}

}  // namespace sidestep
