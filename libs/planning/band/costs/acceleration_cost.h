// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/robot_limits.h"
#include "planning/band/costs/velocity_cost.h"
#include "planning/band/interval.h"

namespace sidestep {

/// Acceleration limits, alpha_k of (2.33). Mean speeds belong to the middle of their intervals, so
///
///   a = 2 (v_2 - v_1) / (dt_1 + dt_2)
///
/// and at the ends, where the speed itself is known, a = 2 (v - v_end) / dt. r = excess; 0 inside.
struct AccelerationCost {
  double accel = 0.5, brake = 0.5, turn_accel = 0.5;
  double soft = 0;  ///< share of a limit within which it is rounded off

  AccelerationCost() = default;
  AccelerationCost(const RobotLimits& limits, double share, double softness = 0)
      : accel(share * limits.accel),
        brake(share * limits.brake),
        turn_accel(share * limits.turn_accel),
        soft(softness) {}

  /// Between two intervals. `add` gets the residual and the gradients of both.
  template <class Add>
  void evaluate(const Interval& i, const Interval& j, Add&& add) const {
    const double k = 2 / (i.dt + j.dt), a = (j.v - i.v) * k, b = (j.w - i.w) * k;
    bothSides(a, up(i.v + j.v), down(i.v + j.v), [&](double r, double s) {
      add(r, MotionGradient{-s * k, 0, 0, -0.5 * s * a * k}, MotionGradient{s * k, 0, 0, -0.5 * s * a * k});
    });
    bothSides(b, turn_accel, turn_accel, [&](double r, double s) {
      add(r, MotionGradient{0, -s * k, 0, -0.5 * s * b * k}, MotionGradient{0, s * k, 0, -0.5 * s * b * k});
    });
  }

  /// From the speeds (v, w) known at the start of an interval, or with `sign` = -1 to those known at its end.
  template <class Add>
  void evaluateEnd(const Interval& i, double v, double w, double sign, Add&& add) const {
    const double k = 2 * sign * i.rate, a = (i.v - v) * k, b = (i.w - w) * k;
    bothSides(a, up(i.v + v), down(i.v + v), [&](double r, double s) {
      add(r, MotionGradient{s * k, 0, 0, -s * a * i.rate});
    });
    bothSides(b, turn_accel, turn_accel, [&](double r, double s) {
      add(r, MotionGradient{0, s * k, 0, -s * b * i.rate});
    });
  }

 private:
  /// What holds at speed v: going backwards, a negative acceleration is speeding up.
  double up(double v) const { return v >= 0 ? accel : brake; }
  double down(double v) const { return v >= 0 ? brake : accel; }

  /// Calls f(residual, its derivative by a) for an acceleration that is over, or near, a limit on either side.
  template <class F>
  void bothSides(double a, double most, double least, F&& f) const {
    double slope = 0;
    if (const double r = softExcess(a - most, soft * most, slope); r > 0) f(r, slope);
    if (const double r = softExcess(-least - a, soft * least, slope); r > 0) f(r, -slope);
  }
};

}  // namespace sidestep
