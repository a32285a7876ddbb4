// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/goal_approach.h"

#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

bool finite(const TPoint2D& p) { return std::isfinite(p.x) && std::isfinite(p.y); }
bool finite(const TPose2D& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.phi); }

/// Why the input cannot be planned on, or null.
const char* whyUnusable(const PlanInput& input) {
  if (!finite(input.pose)) return "the pose is not finite";
  if (!std::isfinite(input.twist.vx) || !std::isfinite(input.twist.omega)) return "the twist is not finite";
  if (!finite(input.goal)) return "the goal is not finite";
  if (!(input.period_s > 0) || !std::isfinite(input.period_s)) return "the period is not positive";
  for (const auto& m : input.moving)
    if (!finite(m.position) || !finite(m.velocity) || !std::isfinite(m.radius_m) || !m.covariance.allFinite())
      return "a moving obstacle is not finite";
  for (const auto& w : input.walls)
    if (!finite(w.a) || !finite(w.b)) return "a wall is not finite";
  for (const auto& p : input.points)
    if (!finite(p)) return "a point is not finite";
  for (const auto& p : input.path)
    if (!finite(p)) return "the path is not finite";
  return nullptr;
}

double approach(double from, double to, double step) { return from + std::clamp(to - from, -step, step); }

}  // namespace

void GoalParams::visit(ParamVisitor& v) {
  v.number("tolerance_m", tolerance_m, {0.001, 100}, "m", "this near the goal is reached");
  v.angle("tolerance_deg", tolerance_rad, {0.01, 180}, "and, where its heading matters, this near to that");
  v.number("lookahead_m", lookahead_m, {0.01, 1000}, "m", "how far ahead on a global path the planner aims");
}

ReachableTwists reachableTwists(const PlanInput& input) {
  const auto& limits = input.limits;
  const double T = input.period_s, v = input.twist.vx, w = input.twist.omega;
  ReachableTwists r;
  r.v_low = std::clamp(v - limits.brake * T, 0.0, limits.v_max);
  r.v_high = std::clamp(v + limits.accel * T, r.v_low, limits.v_max);
  r.w_low = std::clamp(w - limits.turn_accel * T, -limits.w_max, limits.w_max);
  r.w_high = std::clamp(w + limits.turn_accel * T, r.w_low, limits.w_max);
  return r;
}

TPoint2D targetPoint(const PlanInput& input, double lookahead_m) {
  const TPoint2D goal = pointOf(input.goal);
  if (input.path.empty()) return goal;
  double along = 0;
  for (size_t i = nearestPose(input.path, pointOf(input.pose)); i + 1 < input.path.size(); ++i) {
    const TPoint2D a = pointOf(input.path[i]), b = pointOf(input.path[i + 1]);
    const double step = (b - a).norm();
    if (along + step >= lookahead_m) return a + (b - a) * (step > 0 ? (lookahead_m - along) / step : 0);
    along += step;
  }
  return goal;
}

double goalSpeed(const PlanInput& input) {
  constexpr double kForRamps = 0.8;
  const double dx = input.goal.x - input.pose.x, dy = input.goal.y - input.pose.y, d = std::hypot(dx, dy);
  const double bearing = std::min(std::abs(wrapped(std::atan2(dy, dx) - input.pose.phi)), M_PI / 2);
  const double turning = kForRamps * input.limits.w_max * d, stopping = std::sqrt(2 * input.limits.brake * d);
  const double fastest = std::min(input.limits.v_max, stopping);
  if (d * input.limits.w_max > input.limits.v_max) return fastest;
  return turning < 2 * std::sin(bearing) * fastest ? turning / (2 * std::sin(bearing)) : fastest;
}

void beginOutput(PlanOutput& out) {
  out.status = PlanOutput::Status::kNoPlan;
  out.command = {0, 0, 0};
  out.trajectory.clear();
  out.costs.clear();
  out.candidates.clear();
  out.reason.clear();
  if (out.reason.capacity() < 120) out.reason.reserve(120);
}

void brakeFor(const PlanInput& input, const char* reason, PlanOutput& out) {
  const auto& limits = input.limits;
  const double v = std::isfinite(input.twist.vx) ? input.twist.vx : 0;
  const double w = std::isfinite(input.twist.omega) ? input.twist.omega : 0;
  const double T = input.period_s > 0 && std::isfinite(input.period_s) ? input.period_s : 0;
  out.status = PlanOutput::Status::kBraking;
  out.command.vx = std::clamp(approach(v, 0, limits.brake * T), -limits.v_reverse, limits.v_max);
  out.command.omega = std::clamp(approach(w, 0, limits.turn_accel * T), -limits.w_max, limits.w_max);
  out.reason = reason;
}

bool refusesInput(const PlanInput& input, PlanOutput& out) {
  const char* reason = whyUnusable(input);
  if (reason != nullptr) brakeFor(input, reason, out);
  return reason != nullptr;
}

bool answeredAtDoor(const PlanInput& input, const GoalParams& params, PlanOutput& out) {
  if (refusesInput(input, out)) return true;
  if (std::hypot(input.goal.x - input.pose.x, input.goal.y - input.pose.y) > params.tolerance_m) return false;
  const double turn = wrapped(input.goal.phi - input.pose.phi);
  brakeFor(input, "", out);
  out.status = PlanOutput::Status::kGoalReached;
  if (!input.goal_heading_matters || std::abs(turn) <= params.tolerance_rad) return true;
  // Turns on the spot, slowly enough to stop at the goal's heading.
  out.status = PlanOutput::Status::kMoving;
  const double w =
      std::copysign(std::min(input.limits.w_max, std::sqrt(input.limits.turn_accel * std::abs(turn))), turn);
  const auto reach = reachableTwists(input);
  out.command.omega = std::clamp(w, reach.w_low, reach.w_high);
  return true;
}

}  // namespace sidestep
