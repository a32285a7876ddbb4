// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/global_route.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/geometry.h"
#include "maps/nearest_reachable.h"
#include "maps/wall_clearances.h"
#include "planning/global/global_planners.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kMoved_m = 0.3;       ///< who has moved so far does not stand
constexpr double kEndsWithin_m = 2;    ///< longest way from start and goal to where there is room
constexpr double kLeastRoom_m = 0.02;  ///< between the rim and walls, in the tightest passage
constexpr double kTightPrice = 1;      ///< a metre there costs as much as 1 + this with all the room wanted

/// Leaves out points where the straight line keeps as much room as the way it replaces, or all that is wanted.
std::vector<TPoint2D> pulledTaut(const std::vector<TPose2D>& poses, const DistanceField& field, double comfort_m) {
  std::vector<TPoint2D> out;
  for (size_t i = 0; i < poses.size();) {
    out.push_back(pointOf(poses[i]));
    size_t next = i + 1;
    double room_m = comfort_m;
    for (size_t j = i + 1; j < poses.size(); ++j) {
      room_m = std::min(room_m, field.lowestAlong(pointOf(poses[j - 1]), pointOf(poses[j]), comfort_m));
      if (field.visible(pointOf(poses[i]), pointOf(poses[j]), room_m)) next = j;
    }
    i = next;
  }
  return out;
}

}  // namespace

void GlobalRouteParams::visit(ParamVisitor& v) {
  v.choice("planner", planner, {"none", "astar", "theta", "dijkstra"},
           "way among the walls that the local planner gets; none: it goes straight for the goal");
  v.number("margin_m", margin_m, {0, 10}, "m",
           "room wanted between the robot's rim and walls; ways with less cost more, those with none are no ways");
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
  look(own_, pointOf(now.pose), !planned_);
  for (const auto& o : now.moving) {
    const auto [it, is_new] = others_.try_emplace(o.id);
    it->second.radius_m = o.radius_m;
    look(it->second, o.position, is_new);
  }
}

bool GlobalRoute::isDue(const Situation& now) const {
  if (!planned_ || pointOf(goal_) != pointOf(now.goal) || now.time_s - own_.since_s > params_.patience_s) return true;
  if (path_.empty()) return false;
  double nearest = 1e9;
  for (const auto& p : path_) nearest = std::min(nearest, std::hypot(p.x - now.pose.x, p.y - now.pose.y));
  return nearest > params_.off_m + params_.spacing_m;
}

/// From the robot to the goal, points in order; empty if there is no way.
std::vector<TPoint2D> GlobalRoute::plan(const Situation& now, bool around_standing) const {
  const double least_m = radius_m_ + kLeastRoom_m, comfort_m = std::max(radius_m_ + params_.margin_m, least_m);
  const TPoint2D ends[] = {pointOf(now.pose), pointOf(now.goal)};
  WallClearances clearances(now.walls, ends, params_.resolution_m, comfort_m + params_.resolution_m);
  if (around_standing)
    for (const auto& [id, rest] : others_)
      if (now.time_s - rest.since_s >= params_.standing_s) clearances.addDisc(rest.position, rest.radius_m);
  const auto field = std::make_shared<const DistanceField>(clearances.field());
  auto out = wayToClearance(*field, ends[0], least_m, kEndsWithin_m);
  const auto from_goal = wayToClearance(*field, ends[1], least_m, kEndsWithin_m);
  if (out.empty() || from_goal.empty()) return {};
  GlobalPlannerParams params;
  params.clearance_m = least_m;
  params.grid.clearance_weight = kTightPrice;
  params.grid.comfort_m = comfort_m;
  const auto grid = std::make_shared<const PlanningGrid>(field, least_m);
  const TPoint2D start = out.back(), goal = from_goal.back();
  const auto found = makeGlobalPlanner(params_.planner, grid, params)->plan({start.x, start.y, 0}, {goal.x, goal.y, 0});
  if (!found.found()) return {};
  const auto taut = pulledTaut(found.poses, *field, comfort_m);
  out.insert(out.end(), taut.begin(), taut.end());
  out.insert(out.end(), from_goal.rbegin(), from_goal.rend());
  return out;
}

void GlobalRoute::setPath(const std::vector<TPoint2D>& points, const Situation& now) {
  path_.clear();
  path_.push_back(now.pose);
  for (const auto& p : points) {
    const TPose2D from = path_.back();
    const double length = std::hypot(p.x - from.x, p.y - from.y);
    const int n = std::max(1, static_cast<int>(std::lround(length / params_.spacing_m)));
    for (int k = 1; k <= n && length > 1e-6; ++k) {
      const double share = static_cast<double>(k) / n;
      path_.push_back(
          {from.x + share * (p.x - from.x), from.y + share * (p.y - from.y), std::atan2(p.y - from.y, p.x - from.x)});
    }
  }
  path_.back().phi = now.goal.phi;
}

const std::vector<TPose2D>& GlobalRoute::at(const Situation& now) {
  if (params_.planner == "none" || now.walls.empty()) return path_;
  note(now);
  if (!isDue(now)) return path_;
  std::vector<TPoint2D> points = plan(now, true);
  if (points.empty()) points = plan(now, false);
  if (points.empty())
    path_.clear();
  else
    setPath(points, now);
  goal_ = now.goal;
  planned_ = true;
  own_ = {pointOf(now.pose), now.time_s, 0};
  return path_;
}

}  // namespace sidestep
