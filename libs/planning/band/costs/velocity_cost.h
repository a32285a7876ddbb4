// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/robot_limits.h"
#include "planning/band/interval.h"

namespace sidestep {

/// max(0, c), rounded off between -e and e: (c + e)^2 / 4 e. An optimizer that follows tangents sees a limit before it
/// is over it. `slope` gets the derivative.
inline double softExcess(double c, double e, double& slope) {
  if (c >= e) {
    slope = 1;
    return c;
  }
  if (c <= -e) {
    slope = 0;
    return 0;
  }
  slope = (c + e) / (2 * e);
  return slope * (c + e) / 2;
}

/// Speed limits, nu_k of (2.33): r = excess over v_max, v_reverse, w_max, and of either wheel (2.37), (2.38) over
/// wheel_speed_max; 0 inside.
struct VelocityCost {
  double v_max = 1, v_reverse = 0.2, w_max = 2.5, half_track = 0.2, wheel_max = 1e9;
  double soft = 0;  ///< share of a limit within which it is rounded off

  VelocityCost() = default;
  /// @param share  of the limits that the band is to keep to
  VelocityCost(const RobotLimits& limits, double share, double softness = 0)
      : v_max(share * limits.v_max),
        v_reverse(share * limits.v_reverse),
        w_max(share * limits.w_max),
        half_track(limits.track_m / 2),
        wheel_max(share * limits.wheel_speed_max),
        soft(softness) {}

  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    const auto limit = [&](double excess, double of, const MotionGradient& g) {
      double slope = 0;
      const double r = softExcess(excess, soft * of, slope);
      if (r > 0) add(r, MotionGradient{slope * g.v, slope * g.w, 0, 0});
    };
    limit(i.v - v_max, v_max, {1, 0, 0, 0});
    limit(-v_reverse - i.v, v_reverse, {-1, 0, 0, 0});
    limit(i.w - w_max, w_max, {0, 1, 0, 0});
    limit(-w_max - i.w, w_max, {0, -1, 0, 0});
    const double sign_v = i.v < 0 ? -1 : 1, sign_w = i.w < 0 ? -1 : 1;
    const double fastest = sign_v * i.v + sign_w * i.w * half_track;  // the outer wheel's
    limit(fastest - wheel_max, wheel_max, {sign_v, sign_w * half_track, 0, 0});
  }
};

}  // namespace sidestep
