// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "maps/distance_field.h"
#include "planning/band/goal_frame.h"

namespace sidestep {

/// The obstacles of a distance field between start and goal, as one point each, so that bands which pass them on
/// different sides can be told apart.
///
/// The field is sampled on a raster of 2/3 of the robot's radius; samples nearer to an obstacle than half of it are
/// joined to islands. No obstacle falls between samples, and two obstacles between which the robot fits are two
/// islands: samples of one island are never more than 2/3 + 1/2 + 1/2 < 2 radii of obstacle apart.
class FieldIslands {
 public:
  /// @param side  how far beside the straight line to look [m]
  void find(const DistanceField* field, const GoalFrame& frame, double side, double radius_m);
  /// In the order of the raster. A point lies where the robot's centre never is.
  const std::vector<mrpt::math::TPoint2D>& points() const { return points_; }

 private:
  void flood(int from);

  int columns_ = 0, rows_ = 0;
  std::vector<char> near_;  ///< of each sample: whether it belongs to an island that has no point yet
  std::vector<int> open_;
  std::vector<mrpt::math::TPoint2D> points_;
};

}  // namespace sidestep
