// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_check.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <sstream>

#include "core/errors.h"
#include "core/geometry.h"
#include "maps/nearest_reachable.h"
#include "maps/wall_clearances.h"
#include "planning/global/planning_grid.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kCell_m = 0.05, kTouch_m = 1e-6, kToFree_m = 2;

std::string metres(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f m", value);
  return text;
}

std::string shown(const TPoint2D& p) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", p.x, p.y);
  return text;
}

/// A body whose start the scenario says.
struct StartingBody {
  std::string key, name;
  TPoint2D at;
  double radius_m;
};

/// Something that must be reached.
struct Aim {
  std::string key, what;
  TPoint2D at;
  double within_m;
};

class WorldCheck {
 public:
  WorldCheck(const WorldParams& world, std::span<const Segment> map_walls)
      : world_(world), walls_(map_walls.begin(), map_walls.end()) {
    for (const auto& name : world.wall_names) {
      const auto pieces = world.walls.at(name).segments();
      walls_.insert(walls_.end(), pieces.begin(), pieces.end());
    }
  }
  std::vector<WorldProblem> run() {
    listBodies();
    for (const auto& body : bodies_) checkWalls(body);
    for (size_t i = 0; i < bodies_.size(); ++i)
      for (size_t k = 0; k < i; ++k) checkOverlap(bodies_[i], bodies_[k]);
    if (walls_.empty()) return problems_;
    for (const auto& name : world_.robot_names) checkRobotGoals(name, world_.robots.at(name));
    for (const auto& name : world_.people_names) checkPeopleGoals(name, world_.people.at(name));
    return problems_;
  }

 private:
  void listBodies() {
    for (const auto& name : world_.robot_names) {
      const RobotParams& r = world_.robots.at(name);
      if (r.route.length_m <= 0)
        bodies_.push_back({"robots." + name, "robot " + name, {r.x_m, r.y_m}, r.limits.radius_m});
    }
    for (const auto& name : world_.people_names) {
      const PeopleParams& p = world_.people.at(name);
      if (p.start_spread_m <= 0) bodies_.push_back({"people." + name, name, {p.x_m, p.y_m}, p.radius_m});
      if (p.start_spread_m <= 0 && p.count > 1)
        problems_.push_back({"people." + name + ".count",
                             std::to_string(p.count) + " people start at one place; give a start_spread_m"});
    }
  }
  double wallDistance(const TPoint2D& p) const {
    double out = std::numeric_limits<double>::infinity();
    for (const auto& wall : walls_) out = std::min(out, (nearestPoint(wall, p) - p).norm());
    return out;
  }
  void checkWalls(const StartingBody& body) {
    const double distance = wallDistance(body.at);
    if (distance >= body.radius_m - kTouch_m) return;
    problems_.push_back({body.key + ".x_m", body.name + " starts at " + shown(body.at) + ", " + metres(distance) +
                                                " from a wall, but has a radius of " + metres(body.radius_m)});
  }
  void checkOverlap(const StartingBody& a, const StartingBody& b) {
    const double distance = (a.at - b.at).norm();
    if (distance >= a.radius_m + b.radius_m - kTouch_m) return;
    problems_.push_back({a.key + ".x_m", a.name + " starts at " + shown(a.at) + " and overlaps " + b.name + " at " +
                                             shown(b.at) + ", " + metres(distance) + " away"});
  }

  void checkRobotGoals(const std::string& name, const RobotParams& r) {
    if (r.route.length_m > 0) return;
    std::vector<Aim> aims;
    const std::string key = "robots." + name;
    for (size_t k = 0; k < r.goals.size(); ++k)
      aims.push_back(
          {key + ".goals", "goal " + std::to_string(k + 1), {r.goals[k][0], r.goals[k][1]}, r.goal_tolerance_m});
    if (aims.empty()) aims.push_back({key + ".goal_x_m", "the goal", {r.goal_x_m, r.goal_y_m}, r.goal_tolerance_m});
    // half a cell is the raster's doubt, not the world's
    checkAims({r.x_m, r.y_m}, std::max(kCell_m, r.limits.radius_m - 0.5 * kCell_m), "robot " + name, r.limits.radius_m,
              aims);
  }
  void checkPeopleGoals(const std::string& name, const PeopleParams& p) {
    if (p.model == "straight" || p.start_spread_m > 0 || p.speed <= 0) return;
    std::vector<Aim> aims;
    for (size_t k = 0; k < p.waypoints.size(); ++k)
      aims.push_back({"people." + name + ".waypoints",
                      "waypoint " + std::to_string(k + 1),
                      {p.waypoints[k][0], p.waypoints[k][1]},
                      p.radius_m});
    if (p.goal_spread_m <= 0)
      aims.push_back({"people." + name + ".goal_x_m", "the goal", {p.goal_x_m, p.goal_y_m}, p.radius_m});
    checkAims({p.x_m, p.y_m}, 0.15, name, p.radius_m, aims);
  }

  /// Whether ways with so much clearance lead from the start to each aim, or near enough to it.
  void checkAims(const TPoint2D& start, double clearance_m, const std::string& who, double radius_m,
                 const std::vector<Aim>& aims) {
    std::vector<TPoint2D> points{start};
    for (const auto& aim : aims) points.push_back(aim.at);
    const auto field =
        std::make_shared<DistanceField>(WallClearances(walls_, points, kCell_m, clearance_m + kCell_m).field());
    const PlanningGrid grid(field, clearance_m);
    const auto way = wayToClearance(*field, start, clearance_m, kToFree_m);
    if (way.empty()) return;  // starts in a wall, which is told already
    const int32_t component = componentAt(grid, way.back());
    for (const auto& aim : aims) {
      if (reaches(grid, component, aim)) continue;
      const double distance = wallDistance(aim.at);
      problems_.push_back({aim.key, aim.what + " at " + shown(aim.at) + " cannot be reached from the start at " +
                                        shown(start) + ": no way wide enough for " + who + " leads there" +
                                        (distance < radius_m ? "; it lies " + metres(distance) + " from a wall" : "")});
    }
  }
  static int32_t componentAt(const PlanningGrid& grid, const TPoint2D& p) {
    const GridFrame& f = grid.field().frame();
    const int x = static_cast<int>(std::floor((p.x - f.T_map_grid.x) / f.resolution_m));
    const int y = static_cast<int>(std::floor((p.y - f.T_map_grid.y) / f.resolution_m));
    if (x < 0 || y < 0 || x >= f.width || y >= f.height) return 0;
    return grid.component(static_cast<uint32_t>((y + 1) * grid.stride() + x + 1));
  }
  static bool reaches(const PlanningGrid& grid, int32_t component, const Aim& aim) {
    const double side = grid.field().frame().resolution_m;
    const int reach = static_cast<int>(aim.within_m / side) + 1;
    for (int dy = -reach; dy <= reach; ++dy)
      for (int dx = -reach; dx <= reach; ++dx) {
        const TPoint2D at(aim.at.x + dx * side, aim.at.y + dy * side);
        if (std::hypot(dx, dy) * side > aim.within_m + 0.5 * side) continue;
        if (componentAt(grid, at) == component && component != 0) return true;
      }
    return false;
  }

  const WorldParams& world_;
  std::vector<Segment> walls_;
  std::vector<StartingBody> bodies_;
  std::vector<WorldProblem> problems_;
};

/// Line of a key like "robots.robot.x_m", or of the deepest group around it that the text has; 0: none.
int lineOf(const YAML::Node& root, const std::string& key) {
  std::stringstream words(key);
  YAML::Node node = root;
  int line = 0;
  for (std::string word; std::getline(words, word, '.');) {
    if (!node.IsMap()) break;
    bool found = false;
    for (const auto& item : node) {
      if (!item.first.IsScalar() || item.first.Scalar() != word) continue;
      line = item.first.Mark().line + 1;
      node.reset(item.second);
      found = true;
      break;
    }
    if (!found) break;
  }
  return line;
}

YAML::Node parsed(const std::string& yaml) {
  try {
    return YAML::Load(yaml);
  } catch (const YAML::Exception&) {
    return {};  // the strict reader says what is wrong
  }
}

std::string withoutDigits(std::string word) {
  std::erase_if(word, [](unsigned char c) { return std::isdigit(c) != 0; });
  return word;
}

void checkNames(const YAML::Node& group, const std::string& key, const std::vector<std::string>& known,
                const std::vector<std::string>& placing, const std::string& file) {
  if (!group || !group.IsMap() || known.empty()) return;
  for (const auto& item : group) {
    const std::string name = item.first.Scalar();
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string where = file + ":" + std::to_string(item.first.Mark().line + 1) + ": " + key + "." + name;
    const std::string near = nearestWord(name, known);
    if (!near.empty() && withoutDigits(near) != withoutDigits(name))
      throw ConfigError(where + ": the scenario has no such name; did you mean '" + near + "'?");
    const bool placed = item.second.IsMap() && std::any_of(placing.begin(), placing.end(), [&](const auto& word) {
                          return static_cast<bool>(item.second[word]);
                        });
    if (placed) continue;
    std::string all;
    for (const auto& word : known) all += (all.empty() ? "" : ", ") + word;
    throw ConfigError(where + ": the scenario has no such name, it has " + all + "; a new one must say " + placing[0]);
  }
}

}  // namespace

std::vector<WorldProblem> findProblems(const WorldParams& world, std::span<const Segment> map_walls) {
  return WorldCheck(world, map_walls).run();
}

std::string describe(const std::vector<WorldProblem>& problems, const std::string& file, const std::string& yaml) {
  const YAML::Node root = parsed(yaml);
  std::string out;
  for (const auto& p : problems) {
    const int line = root ? lineOf(root, p.key) : 0;
    out +=
        (out.empty() ? "" : "\n") + file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + p.key + ": " + p.what;
  }
  return out;
}

void checkNewNames(const std::string& set, const std::string& name, const WorldParams& known) {
  const YAML::Node root = parsed(set);
  if (!root || !root.IsMap()) return;
  checkNames(root["walls"], "walls", known.wall_names, {"points"}, name);
  checkNames(root["robots"], "robots", known.robot_names, {"x_m", "y_m", "route"}, name);
  checkNames(root["people"], "people", known.people_names, {"x_m", "y_m", "start_spread_m"}, name);
}

void checkKind(const std::string& yaml, const std::string& file) {
  const YAML::Node root = parsed(yaml);
  if (!root || !root.IsMap() || root["kind"]) return;
  for (const char* key : {"robots", "walls", "people"})
    if (root[key])
      throw ConfigError(file + ":" + std::to_string(lineOf(root, key)) + ": " + key +
                        " belongs to a world, and the file says no kind; did you mean 'kind: world'?");
}

}  // namespace sidestep
