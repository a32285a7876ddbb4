// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/crossing_run.h"

#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

constexpr double kStep_s = 0.05;
constexpr int kStepsPerPlan = 2;

/// Whether a command respects limits and what the base can reach from `now`.
bool inside(const mrpt::math::TTwist2D& c, const mrpt::math::TTwist2D& now, const PlanInput& in) {
  const auto& l = in.limits;
  constexpr double kRound = 1e-9;
  const double dv = std::abs(c.vx - now.vx), dw = std::abs(c.omega - now.omega);
  return c.vx <= l.v_max && c.vx >= -l.v_reverse && std::abs(c.omega) <= l.w_max &&
         dv <= std::max(l.accel, l.brake) * in.period_s + kRound && dw <= l.turn_accel * in.period_s + kRound;
}

/// Moves `pose` by one step while speeds change evenly from what they were to what was ordered.
/// @param share  of that change which is done in the middle of the step
void advance(mrpt::math::TPose2D& pose, const mrpt::math::TTwist2D& before, const mrpt::math::TTwist2D& ordered,
             double share) {
  const double v = before.vx + share * (ordered.vx - before.vx);
  const double w = before.omega + share * (ordered.omega - before.omega);
  const double heading = pose.phi + w * kStep_s / 2;
  pose.x += v * kStep_s * std::cos(heading);
  pose.y += v * kStep_s * std::sin(heading);
  pose.phi = std::remainder(pose.phi + w * kStep_s, 2 * M_PI);
}

}  // namespace

CrossingRow runCrossing(const PlanningProblem& problem, const CrossingRun& run, LocalPlanner& planner) {
  CrossingRow row{problem.seed, "timeout", run.time_max_s, 1e9, {}};
  MotionPredictor predictor(run.predictor);
  std::vector<MovingObstacle> seen, people = problem.obstacles;
  PlanInput in;
  in.goal = {10, 0, 0};
  in.limits = run.robot;
  PlanOutput out;
  planner.reset();
  mrpt::math::TTwist2D before;
  const int steps = static_cast<int>(run.time_max_s / kStep_s);
  for (int step = 0; step <= steps; ++step) {
    in.time_s = step * kStep_s;
    for (const auto& o : people) {
      predictor.observe(in.time_s, o.id, o.position, 0.02, o.radius_m);
      const double apart = std::hypot(o.position.x - in.pose.x, o.position.y - in.pose.y);
      row.min_clearance_m = std::min(row.min_clearance_m, apart - o.radius_m - run.robot.radius_m);
    }
    const bool there = std::hypot(in.goal.x - in.pose.x, in.goal.y - in.pose.y) <= run.goal_m;
    if (row.min_clearance_m < 0 || there) {
      row.outcome = there && row.min_clearance_m >= 0 ? "goal" : "contact";
      row.time_s = in.time_s;
      return row;
    }
    if (step % kStepsPerPlan == 0) {
      predictor.predict(in.time_s, seen);
      in.moving = seen;
      const double from = run.cpu_ms();
      planner.plan(in, out);
      row.plan_ms.push_back(run.cpu_ms() - from);
      row.outside_limits |= !inside(out.command, in.twist, in);
      row.braked += out.status == PlanOutput::Status::kMoving ? 0 : 1;
      before = in.twist;
    }
    advance(in.pose, before, out.command, (step % kStepsPerPlan + 0.5) / kStepsPerPlan);
    if (step % kStepsPerPlan == kStepsPerPlan - 1) in.twist = out.command;
    for (auto& o : people) o.position = o.position + o.velocity * kStep_s;
  }
  return row;
}

}  // namespace sidestep
