// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>

#include "planning/band/footprint.h"
#include "planning/band/interval.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// Clearance, o_k of (2.33) and of (4.12): for each obstacle near a pose r = missing distance between the robot's
/// outline (each of its discs) and the obstacle, where that is then; 0 at the wished distance and beyond.
struct ClearanceCost {
  Footprint robot;
  double distance = 0.5;  ///< wished, from edge to edge [m]
  double moving = 0.5;    ///< wished to what moves [m]

  template <class Add>
  void evaluate(const BandPose& pose, const ObstacleView& obstacles, Add&& add) const {
    if (robot.isDisc()) {
      evaluateDisc(pose, 0, 0, obstacles, add);
      return;
    }
    const double c = std::cos(pose.theta), s = std::sin(pose.theta);
    for (int i = 0; i < robot.discs; ++i) evaluateDisc(pose, robot.along(i) * c, robot.along(i) * s, obstacles, add);
  }

 private:
  /// One disc, (ahead_x, ahead_y) from the base in the map frame.
  template <class Add>
  void evaluateDisc(const BandPose& pose, double ahead_x, double ahead_y, const ObstacleView& obstacles,
                    Add&& add) const {
    const double reach = robot.radius_m + std::max(distance, moving);
    obstacles.near(pose.x + ahead_x, pose.y + ahead_y, pose.t, reach, [&](const Proximity& p) {
      const double missing = robot.radius_m + (p.moving ? moving : distance) - p.distance;
      if (missing > 0) add(missing, PoseGradient{-p.dx, -p.dy, p.dx * ahead_y - p.dy * ahead_x, -p.dt});
    });
  }
};

}  // namespace sidestep
