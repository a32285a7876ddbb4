// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>

namespace sidestep {

/// A pair (v, w) held over the look-ahead, and what it meets. Frame: the robot's at the start.
struct Rollout {
  double v = 0, w = 0;                                      ///< [m/s], [rad/s]
  double free_s = std::numeric_limits<double>::infinity();  ///< until it touches something; infinity: it does not
  int touched = -1;                                         ///< the moving obstacle that it touches; -1: a static one
  double gap_m = std::numeric_limits<double>::infinity();   ///< to what it touches or passes nearest, as far as looked
  bool stops = true;                                        ///< (2.24): the robot can stop before it touches something
  bool admissible = true;                                   ///< that, and where it can stop nobody comes
  double total = 0;                                         ///< the weighted loss; the smallest wins
};

/// What scorers may know beside the rollout.
struct ScoringView {
  double goal_x = 0, goal_y = 0;  ///< where to [m], robot's frame
  double v_max = 1;
  double look_ahead_s = 3;
  double adviser_heading = 0;  ///< direction of the velocity (2.29), robot's frame [rad]; 0 without an adviser
  double adviser_speed = 0;    ///< its length [m/s]
};

}  // namespace sidestep
