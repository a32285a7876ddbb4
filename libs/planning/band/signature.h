// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "planning/band/band.h"
#include "planning/band/goal_frame.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// The class of a band as a number: two bands with the same ends have the same one exactly when they pass each obstacle
/// the same way round.
///
/// H-signature by crossings (Bhattacharya 2011): from each obstacle a ray goes off to the right of the straight line to
/// the goal; how often the band crosses it, counted with sign, is that obstacle's entry, and no deformation that keeps
/// clear of the obstacle changes it. For a moving obstacle the band is taken relative to it, at equal times, until
/// `horizon_s` (the robot waits at the goal): passing in front and passing behind differ. The entries are summed with
/// fixed random factors into 64 bits, so that comparing two bands costs one comparison.
///
/// Computed in one pass over obstacles and poses; obstacles beside the band cost nothing more than a look.
class SignatureReader {
 public:
  /// @param islands  one point of each obstacle of a distance field
  uint64_t read(const Band& band, const GoalFrame& frame, const ObstacleView& obstacles, double horizon_s,
                std::span<const mrpt::math::TPoint2D> islands = {});

 private:
  int crossings(double u, double v) const;
  int crossingsMoving(const ObstacleView& obstacles, const GoalFrame& frame, size_t index, double horizon_s) const;

  struct Point {
    double u, v, t;
  };
  std::vector<Point> points_;
  double v_low_ = 0, v_high_ = 0;
};

}  // namespace sidestep
