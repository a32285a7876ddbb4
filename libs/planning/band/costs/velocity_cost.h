// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/robot_limits.h"
#include "planning/band/interval.h"

namespace sidestep {

/// Speed limits, nu_k of (2.33): r = excess over v_max, v_reverse, w_max, and of either wheel (2.37), (2.38) over
/// wheel_speed_max; 0 inside.
struct VelocityCost {
  double v_max = 1, v_reverse = 0.2, w_max = 2.5, half_track = 0.2, wheel_max = 1e9;

  VelocityCost() = default;
  /// @param share  of the limits that the band is to keep to
  VelocityCost(const RobotLimits& limits, double share)
      : v_max(share * limits.v_max),
        v_reverse(share * limits.v_reverse),
        w_max(share * limits.w_max),
        half_track(limits.track_m / 2),
        wheel_max(share * limits.wheel_speed_max) {}

  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    if (i.v > v_max) add(i.v - v_max, MotionGradient{1, 0, 0, 0});
    if (i.v < -v_reverse) add(-v_reverse - i.v, MotionGradient{-1, 0, 0, 0});
    if (i.w > w_max) add(i.w - w_max, MotionGradient{0, 1, 0, 0});
    if (i.w < -w_max) add(-w_max - i.w, MotionGradient{0, -1, 0, 0});
    const double sign_v = i.v < 0 ? -1 : 1, sign_w = i.w < 0 ? -1 : 1;
    const double fastest = sign_v * i.v + sign_w * i.w * half_track;  // the outer wheel's
    if (fastest > wheel_max) add(fastest - wheel_max, MotionGradient{sign_v, sign_w * half_track, 0, 0});
  }
};

}  // namespace sidestep
