// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/command_limits.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

double orZero(double value) { return std::isfinite(value) ? value : 0; }

/// Speed limits of the wheels: the way towards standing still keeps the curvature.
void keepWheels(double& v, double& w, const RobotLimits& limits) {
  const double fastest = outerWheelSpeed(v, w, limits.track_m);
  if (fastest <= limits.wheel_speed_max) return;
  const double share = limits.wheel_speed_max / fastest * (1 - 1e-12);
  v *= share;
  w *= share;
}

}  // namespace

mrpt::math::TTwist2D allowedCommand(double v, double w, const mrpt::math::TTwist2D& now, const RobotLimits& limits,
                                    double period_s) {
  const double v_now = std::clamp(orZero(now.vx), -limits.v_reverse, limits.v_max);
  const double w_now = std::clamp(orZero(now.omega), -limits.w_max, limits.w_max);
  const double up = (v_now >= 0 ? limits.accel : limits.brake) * period_s;
  const double down = (v_now > 0 ? limits.brake : limits.accel) * period_s, turn = limits.turn_accel * period_s;
  v = std::clamp(orZero(v), std::max(v_now - down, -limits.v_reverse), std::min(v_now + up, limits.v_max));
  w = std::clamp(orZero(w), std::max(w_now - turn, -limits.w_max), std::min(w_now + turn, limits.w_max));
  keepWheels(v, w, limits);
  return {v, 0, w};
}

}  // namespace sidestep
