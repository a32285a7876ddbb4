// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/any_angle_planner.h"

#include "planning/global/taut_path.h"

namespace sidestep {
namespace {

GridSearchParams withKnights(GridSearchParams params) {
  params.neighbours = 16;
  return params;
}

}  // namespace

AnyAnglePlanner::AnyAnglePlanner(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params)
    : grid_(std::move(grid)), astar_(grid_, withKnights(params), true) {}

GlobalPath AnyAnglePlanner::plan(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) {
  GlobalPath out = astar_.plan(start, goal);
  if (!out.found()) return out;
  points_.clear();
  for (const auto& p : out.poses) points_.emplace_back(p.x, p.y);
  pullTaut(grid_->field(), grid_->clearance(), points_);
  out.poses = posesAlong(points_, goal.phi);
  out.cost = pathLength(out.poses);
  return out;
}

}  // namespace sidestep
