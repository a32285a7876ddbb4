// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/evasion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/kinematics.h"

namespace sidestep {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kProgress = 0.05;  ///< clearance that a metre towards the target is worth

/// Speed after dt on the way to a wanted one.
double towards(double now, double wanted, double dt, double accel, double brake) {
  const bool slower = std::abs(wanted) < std::abs(now) || wanted * now < 0;
  const double most = (slower ? brake : accel) * dt;
  return now + std::clamp(wanted - now, -most, most);
}

}  // namespace

void EvasionParams::visit(ParamVisitor& v) {
  v.number("before_s", before_s, {0, 30}, "s",
           "evading is looked at when the chosen band touches something that moves within this time; 0: only when no "
           "band's beginning is clear");
  v.number("ahead_s", ahead_s, {0.5, 30}, "s", "for how long a manoeuvre is looked at");
  v.number("clearance_m", clearance_m, {0, 5}, "m", "more clearance than this is no better");
  v.number("step_s", step_s, {0.01, 1}, "s", "between the poses that are looked at");
}

bool Evasion::Answer::clear() const { return contact_s == kNever; }

Evasion::Answer Evasion::drive(const PlanInput& input, const ObstacleView& obstacles, const Manoeuvre& m) {
  const RobotLimits& limits = input.limits;
  Answer out{{}, kNever, params_.clearance_m};
  driven_.clear();
  driven_.reserve(static_cast<size_t>(params_.ahead_s / params_.step_s) + 2);
  TrajectoryPoint p{0, input.pose, input.twist.vx, input.twist.omega};
  double turned = 0, start = kNever;
  const double reach = limits.radius_m + params_.clearance_m, dt = params_.step_s;
  for (int k = 0; k * dt < params_.ahead_s; ++k) {
    const double left = m.turn - turned;
    const bool turning = left * m.turn > 0.1 * std::abs(m.turn);
    // fast enough to stop turning in time
    const double most = std::min(limits.w_max, std::sqrt(2 * limits.turn_accel * std::abs(left)));
    const double v = turning ? 0 : m.v, w = turning ? std::copysign(most, left) : m.w;
    p.v = towards(p.v, v, dt, limits.accel, limits.brake);
    p.w = towards(p.w, w, dt, limits.turn_accel, limits.turn_accel);
    p.pose = alongChord(p.pose, p.v * dt, p.w * dt);
    p.after_s += dt;
    turned += p.w * dt;
    driven_.push_back(p);
    double clearance = params_.clearance_m;
    obstacles.near(p.pose.x, p.pose.y, p.after_s, reach, [&](const Proximity& o) {
      clearance = std::min(clearance, o.distance + o.widening - limits.radius_m);
    });
    if (k == 0) start = std::min(clearance, 0.0);
    out.least_m = std::min(out.least_m, clearance);
    if (clearance < start - 1e-6 || (clearance < 0 && p.after_s > 1)) {
      out.contact_s = p.after_s;
      break;
    }
  }
  const TrajectoryPoint& first =
      driven_[std::min(driven_.size() - 1, static_cast<size_t>(std::lround(std::max(input.period_s / dt - 1, 0.0))))];
  out.command = {first.v, 0, first.w};
  return out;
}

Evasion::Answer Evasion::stand(const PlanInput& input, const ObstacleView& obstacles) {
  return drive(input, obstacles, {});
}

Evasion::Answer Evasion::best(const PlanInput& input, const ObstacleView& obstacles,
                              const mrpt::math::TPoint2D& target) {
  const RobotLimits& limits = input.limits;
  Answer best;
  double best_score = -kNever;
  const auto look = [&](const Manoeuvre& m) {
    const Answer a = drive(input, obstacles, m);
    const auto& end = driven_.back().pose;
    const double far = std::hypot(target.x - end.x, target.y - end.y);
    const double score = (a.clear() ? a.least_m : a.contact_s - 2 * params_.ahead_s) - kProgress * far;
    if (score <= best_score) return;
    best_score = score;
    best = a;
    best_ = driven_;
  };
  look({});
  const double w_most = std::min(limits.w_max, 2.0);
  for (const double v : {1.0, 0.6, 0.3, 0.0})
    for (const double w : {0.0, 0.2, -0.2, 0.5, -0.5, 1.0, -1.0}) look({0, v * limits.v_max, w * w_most});
  for (const double w : {0.0, 0.3, -0.3}) look({0, -limits.v_reverse, w * w_most});
  for (const double turn : {M_PI / 4, M_PI / 2, 3 * M_PI / 4, M_PI})
    for (const double side : {1.0, -1.0}) look({side * turn, limits.v_max, 0});
  return best;
}

}  // namespace sidestep
