// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>

#include "planning/band/interval.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// Clearance, o_k of (2.33) and of (4.12): for each obstacle near a pose r = missing distance between the robot's disc
/// and the obstacle, where that is then; 0 at the wished distance and beyond.
struct ClearanceCost {
  double radius = 0.3;    ///< robot's [m]
  double distance = 0.5;  ///< wished, from edge to edge [m]
  double moving = 0.5;    ///< wished to what moves [m]

  template <class Add>
  void evaluate(const BandPose& pose, const ObstacleView& obstacles, Add&& add) const {
    obstacles.near(pose.x, pose.y, pose.t, radius + std::max(distance, moving), [&](const Proximity& p) {
      const double missing = radius + (p.moving ? moving : distance) - p.distance;
      if (missing > 0) add(missing, PoseGradient{-p.dx, -p.dy, 0, -p.dt});
    });
  }
};

}  // namespace sidestep
