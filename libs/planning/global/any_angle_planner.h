// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include "planning/global/grid_search.h"

namespace sidestep {

/// The planner "theta": paths at any angle, as Theta* (Nash, Daniel, Koenig & Felner 2007) finds them, by another way:
/// A* with 16 neighbours, whose path is then pulled taut. It is never longer than A*'s of 8 neighbours, since those
/// moves are among the 16 and pulling only shortens. doc/maps-and-paths.md compares it with Theta* itself.
class AnyAnglePlanner final : public GlobalPlanner {
 public:
  /// @param params  `neighbours` is not looked at; with a clearance price the search looks for room, then pulling takes
  ///                back what it can without touching an obstacle
  AnyAnglePlanner(std::shared_ptr<const PlanningGrid> grid, const GridSearchParams& params);
  GlobalPath plan(const mrpt::math::TPose2D& start, const mrpt::math::TPose2D& goal) override;

 private:
  std::shared_ptr<const PlanningGrid> grid_;
  GridPlanner astar_;
  std::vector<mrpt::math::TPoint2D> points_;
};

}  // namespace sidestep
