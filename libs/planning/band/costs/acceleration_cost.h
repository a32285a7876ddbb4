// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/robot_limits.h"
#include "planning/band/interval.h"

namespace sidestep {

/// Acceleration limits, alpha_k of (2.33). Mean speeds belong to the middle of their intervals, so
///
///   a = 2 (v_2 - v_1) / (dt_1 + dt_2)
///
/// and at the ends, where the speed itself is known, a = 2 (v - v_end) / dt. r = excess; 0 inside.
struct AccelerationCost {
  double accel = 0.5, brake = 0.5, turn_accel = 0.5;

  AccelerationCost() = default;
  AccelerationCost(const RobotLimits& limits, double share)
      : accel(share * limits.accel), brake(share * limits.brake), turn_accel(share * limits.turn_accel) {}

  /// Excess of `a` over what holds at speed `v` (going backwards, a negative one is speeding up), with its sign.
  double excess(double v, double a) const {
    const double up = v >= 0 ? accel : brake, down = v >= 0 ? brake : accel;
    return a > up ? a - up : a < -down ? a + down : 0;
  }
  double turnExcess(double a) const { return a > turn_accel ? a - turn_accel : a < -turn_accel ? a + turn_accel : 0; }

  /// Between two intervals. `add` gets the residual and the gradients of both.
  template <class Add>
  void evaluate(const Interval& i, const Interval& j, Add&& add) const {
    const double k = 2 / (i.dt + j.dt), a = (j.v - i.v) * k, b = (j.w - i.w) * k;
    if (const double r = excess(i.v + j.v, a); r != 0)
      add(r, MotionGradient{-k, 0, 0, -0.5 * a * k}, MotionGradient{k, 0, 0, -0.5 * a * k});
    if (const double r = turnExcess(b); r != 0)
      add(r, MotionGradient{0, -k, 0, -0.5 * b * k}, MotionGradient{0, k, 0, -0.5 * b * k});
  }

  /// From the speeds (v, w) known at the start of an interval, or with `sign` = -1 to those known at its end.
  template <class Add>
  void evaluateEnd(const Interval& i, double v, double w, double sign, Add&& add) const {
    const double k = 2 * sign * i.rate, a = (i.v - v) * k, b = (i.w - w) * k;
    if (const double r = excess(i.v + v, a); r != 0) add(r, MotionGradient{k, 0, 0, -a * i.rate});
    if (const double r = turnExcess(b); r != 0) add(r, MotionGradient{0, k, 0, -b * i.rate});
  }
};

}  // namespace sidestep
