// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cmath>

namespace sidestep {

/// Frame of one plan: from the start straight to the goal along u, v to the left.
struct GoalFrame {
  double x = 0, y = 0, c = 1, s = 0;
  double length = 0;  ///< from start to goal [m]

  GoalFrame() = default;
  GoalFrame(double start_x, double start_y, double goal_x, double goal_y)
      : x(start_x), y(start_y), length(std::hypot(goal_x - start_x, goal_y - start_y)) {
    if (length < 1e-6) return;
    c = (goal_x - start_x) / length;
    s = (goal_y - start_y) / length;
  }
  double u(double px, double py) const { return c * (px - x) + s * (py - y); }
  double v(double px, double py) const { return c * (py - y) - s * (px - x); }
  mrpt::math::TPoint2D point(double u_at, double v_at) const {
    return {x + c * u_at - s * v_at, y + s * u_at + c * v_at};
  }
};

}  // namespace sidestep
