// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/global_route.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "planning/global/global_planners.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kMoved_m = 0.3;     ///< who has moved so far does not stand
constexpr double kAround_m = 1;      ///< of the map, beyond the walls
constexpr double kEndsWithin_m = 2;  ///< start and goal may be moved so far to where there is room

TPoint2D place(const TPose2D& p) { return {p.x, p.y}; }

/// A raster around walls and some points, with what is in the way.
class Raster {
 public:
  Raster(const Situation& now, double resolution_m) {
    double x_min = std::min(now.pose.x, now.goal.x), x_max = std::max(now.pose.x, now.goal.x);
    double y_min = std::min(now.pose.y, now.goal.y), y_max = std::max(now.pose.y, now.goal.y);
    for (const auto& wall : now.walls)
      for (const auto& p : {wall.a, wall.b}) {
        x_min = std::min(x_min, p.x), x_max = std::max(x_max, p.x);
        y_min = std::min(y_min, p.y), y_max = std::max(y_max, p.y);
      }
    frame_.resolution_m = resolution_m;
    frame_.T_map_grid = {x_min - kAround_m, y_min - kAround_m, 0};
    frame_.width = 1 + static_cast<int>((x_max - x_min + 2 * kAround_m) / resolution_m);
    frame_.height = 1 + static_cast<int>((y_max - y_min + 2 * kAround_m) / resolution_m);
    blocked_.assign(static_cast<size_t>(frame_.width) * static_cast<size_t>(frame_.height), 0);
    for (const auto& wall : now.walls) line(wall);
  }
  void disc(const TPoint2D& centre, double radius_m) {
    const int reach = 1 + static_cast<int>(radius_m / frame_.resolution_m);
    const int x = cell(centre.x - frame_.T_map_grid.x), y = cell(centre.y - frame_.T_map_grid.y);
    for (int iy = y - reach; iy <= y + reach; ++iy)
      for (int ix = x - reach; ix <= x + reach; ++ix)
        if ((frame_.centre(ix, iy) - centre).norm() <= radius_m) block(ix, iy);
  }
  DistanceField field() const { return DistanceField(frame_, blocked_); }

 private:
  int cell(double off_m) const { return static_cast<int>(std::floor(off_m / frame_.resolution_m)); }
  void block(int ix, int iy) {
    if (ix < 0 || iy < 0 || ix >= frame_.width || iy >= frame_.height) return;
    blocked_[static_cast<size_t>(iy) * static_cast<size_t>(frame_.width) + static_cast<size_t>(ix)] = 1;
  }
  void line(const Segment& wall) {
    const TPoint2D along = wall.b - wall.a;
    const int n = 1 + static_cast<int>(2 * along.norm() / frame_.resolution_m);
    for (int k = 0; k <= n; ++k) {
      const TPoint2D p = wall.a + along * (static_cast<double>(k) / n);
      block(cell(p.x - frame_.T_map_grid.x), cell(p.y - frame_.T_map_grid.y));
    }
  }

  GridFrame frame_;
  std::vector<uint8_t> blocked_;
};

}  // namespace

void GlobalRouteParams::visit(ParamVisitor& v) {
  v.choice("planner", planner, {"none", "astar", "theta", "dijkstra"},
           "way among the walls that the local planner gets; none: it goes straight for the goal");
  v.number("margin_m", margin_m, {0, 10}, "m", "room between the robot's rim and walls, where there is so much");
  v.number("resolution_m", resolution_m, {0.02, 1}, "m", "cells of the map made of the walls");
  v.number("spacing_m", spacing_m, {0.05, 10}, "m", "between the path's points");
  v.number("off_m", off_m, {0.1, 100}, "m", "so far off the path, it is planned anew");
  v.number("patience_s", patience_s, {0.1, 1000}, "s", "so is it when the robot has not got on for so long");
  v.number("standing_s", standing_s, {0.1, 1000}, "s", "who has not moved for so long is planned around");
}

/// Who stands, and whether the robot itself does.
void GlobalRoute::note(const Situation& now) {
  const auto look = [&](Rest& rest, const TPoint2D& position, bool is_new) {
    if (!is_new && (position - rest.position).norm() < kMoved_m) return;
    rest.position = position;
    rest.since_s = now.time_s;
  };
  look(own_, place(now.pose), !planned_);
  for (const auto& o : now.moving) {
    const auto [it, is_new] = others_.try_emplace(o.id);
    it->second.radius_m = o.radius_m;
    look(it->second, o.position, is_new);
  }
}

bool GlobalRoute::isDue(const Situation& now) const {
  if (!planned_ || place(goal_) != place(now.goal) || now.time_s - own_.since_s > params_.patience_s) return true;
  if (path_.empty()) return false;
  double nearest = 1e9;
  for (const auto& p : path_) nearest = std::min(nearest, std::hypot(p.x - now.pose.x, p.y - now.pose.y));
  return nearest > params_.off_m + params_.spacing_m;
}

GlobalPath GlobalRoute::plan(const Situation& now, bool around_standing) const {
  Raster raster(now, params_.resolution_m);
  if (around_standing)
    for (const auto& [id, rest] : others_)
      if (now.time_s - rest.since_s >= params_.standing_s) raster.disc(rest.position, rest.radius_m);
  const auto field = std::make_shared<const DistanceField>(raster.field());
  GlobalPath out;
  for (const double margin : {params_.margin_m, 0.5 * params_.margin_m, 0.5 * params_.resolution_m}) {
    const double clearance = radius_m_ + margin;
    const auto start = field->nearestFree(place(now.pose), clearance, kEndsWithin_m);
    const auto goal = field->nearestFree(place(now.goal), clearance, kEndsWithin_m);
    if (!start || !goal) continue;
    GlobalPlannerParams params;
    params.clearance_m = clearance;
    const auto grid = std::make_shared<const PlanningGrid>(field, clearance);
    out = makeGlobalPlanner(params_.planner, grid, params)->plan({start->x, start->y, 0}, {goal->x, goal->y, 0});
    if (out.found()) break;
  }
  return out;
}

void GlobalRoute::setPath(const std::vector<TPose2D>& poses, const Situation& now) {
  path_.clear();
  path_.push_back(now.pose);
  const auto to = [&](const TPose2D& p) {
    const TPose2D from = path_.back();
    const double length = std::hypot(p.x - from.x, p.y - from.y);
    const int n = std::max(1, static_cast<int>(std::lround(length / params_.spacing_m)));
    for (int k = 1; k <= n && length > 1e-6; ++k) {
      const double share = static_cast<double>(k) / n;
      path_.push_back({from.x + share * (p.x - from.x), from.y + share * (p.y - from.y), p.phi});
    }
  };
  for (const auto& p : poses) to(p);
  to(now.goal);
}

const std::vector<TPose2D>& GlobalRoute::at(const Situation& now) {
  if (params_.planner == "none" || now.walls.empty()) return path_;
  note(now);
  if (!isDue(now)) return path_;
  GlobalPath found = plan(now, true);
  if (!found.found()) found = plan(now, false);
  if (found.found())
    setPath(found.poses, now);
  else
    path_.clear();
  goal_ = now.goal;
  planned_ = true;
  own_ = {place(now.pose), now.time_s, 0};
  return path_;
}

}  // namespace sidestep
