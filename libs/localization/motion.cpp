// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/motion.h"

#include <cmath>

#include "core/kinematics.h"

namespace sidestep {

MotionStep MotionStep::part(double fraction) const {
  MotionStep p = *this;
  p.dt_s *= fraction;
  p.distance_m *= fraction;
  p.turn_rad *= fraction;
  p.distance_var *= fraction;
  p.turn_var *= fraction;
  return p;
}

void MotionNoiseParams::visit(ParamVisitor& v) {
  v.number("a1", a1, {0, 10}, "(m/s)/(m/s)", "speed noise by speed (3.2)");
  v.number("a2", a2, {0, 10}, "(m/s)/(rad/s)", "speed noise by turn rate (3.2)");
  v.number("a3", a3, {0, 10}, "(rad/s)/(m/s)", "turn-rate noise by speed (3.2)");
  v.number("a4", a4, {0, 10}, "(rad/s)/(rad/s)", "turn-rate noise by turn rate (3.2)");
  v.number("a5", a5, {0, 10}, "(rad/s)/(m/s)", "final-turn noise by speed (3.6)");
  v.number("a6", a6, {0, 10}, "(rad/s)/(rad/s)", "final-turn noise by turn rate (3.6)");
  v.number("noise_period_s", noise_period_s, {0, 1000}, "s",
           "time over which these are the sd of an average; 0 = of each step, as printed");
  v.number("turn_floor", turn_floor, {0, 10}, "rad/s", "turn-rate noise that is always there while moving");
}

void MotionNoiseParams::apply(MotionStep& s) const {
  if (s.dt_s <= 0) return;
  const double v = std::abs(s.distance_m) / s.dt_s, w = std::abs(s.turn_rad) / s.dt_s;
  const double sd_v = a1 * v + a2 * w;
  const double sd_w = a3 * v + a4 * w + turn_floor;
  const double sd_gamma = a5 * v + a6 * w;
  const double dt2 = s.dt_s * (noise_period_s > 0 ? noise_period_s : s.dt_s);
  s.distance_var = sd_v * sd_v * dt2;
  s.turn_var = (sd_w * sd_w + sd_gamma * sd_gamma) * dt2;
}

mrpt::math::TPose2D moved(const mrpt::math::TPose2D& pose, const MotionStep& step) {
  return alongChord(pose, step.distance_m, step.turn_rad);
}

}  // namespace sidestep
