// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/band_benchmark.h"

#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

double medianOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

/// The problem as the planner sees it at one instant.
struct Scene {
  PlanInput input;
  std::vector<mrpt::math::TPoint2D> points;
  std::vector<MovingObstacle> moving;

  Scene(const PlanningProblem& problem, const BandBenchmark& run) {
    input.goal = {8, 0, 0};
    input.limits = run.robot;
    if (run.moving)
      moving = problem.obstacles;
    else
      for (const auto& o : problem.obstacles) points.push_back(o.position);
    input.points = points;
    input.moving = moving;
  }

  /// The robot drives the order, speeds changing evenly over the period; obstacles go on.
  void advance(const mrpt::math::TTwist2D& command) {
    constexpr int kSteps = 4;
    const double dt = input.period_s / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      const double share = (k + 0.5) / kSteps;
      const double v = input.twist.vx + share * (command.vx - input.twist.vx);
      const double w = input.twist.omega + share * (command.omega - input.twist.omega);
      const double heading = input.pose.phi + w * dt / 2;
      input.pose.x += v * dt * std::cos(heading);
      input.pose.y += v * dt * std::sin(heading);
      input.pose.phi += w * dt;
    }
    input.twist = command;
    input.time_s += input.period_s;
    for (auto& o : moving) o.position = o.position + o.velocity * input.period_s;
  }
};

/// Least distance between the robot's rim and an obstacle's along the band, where the obstacle is then.
double leastDistance(const Band& band, const PlanningProblem& problem, const BandBenchmark& run) {
  constexpr double kStep_s = 0.02;
  double least = std::numeric_limits<double>::infinity();
  for (double t = 0; t <= band.back().t + kStep_s; t += kStep_s) {
    const BandPose p = bandAt(band, t);
    for (const auto& o : problem.obstacles) {
      const auto at = run.moving ? o.position + o.velocity * std::min(t, band.back().t) : o.position;
      least = std::min(least, std::hypot(p.x - at.x, p.y - at.y) - o.radius_m - run.robot.radius_m);
    }
  }
  return least;
}

void describe(const BandCandidate& best, const PlanningProblem& problem, const BandBenchmark& run, BandResult& row) {
  const BandExtremes most = extremesOf(best.band, best.ends);
  row.poses = static_cast<int>(best.band.size());
  row.transition_s = best.band.back().t;
  row.min_dist_m = leastDistance(best.band, problem, run);
  row.status = row.min_dist_m >= 0 ? "clear" : "contact";
  row.max_v = most.v;
  row.max_w = most.w;
  row.max_a = most.a;
  row.max_alpha = most.turn_accel;
  for (double share : best.shares) row.cost += share;
}

}  // namespace

BandResult benchmarkBand(const PlanningProblem& problem, const BandBenchmark& run, BandPlanner& planner) {
  BandResult row;
  row.n_obs = problem.n_obs;
  row.seed = problem.seed;
  row.status = "none";
  PlanOutput out;
  std::vector<double> cold, warm;
  Scene scene(problem, run);
  for (int k = 0; k < run.repeats; ++k) {
    planner.reset();
    const double from = run.cpu_ms();
    planner.plan(scene.input, out);
    cold.push_back(run.cpu_ms() - from);
  }
  if (const auto* best = planner.chosen()) describe(*best, problem, run, row);
  if (run.planned_cold) run.planned_cold(problem, planner);
  if (run.explained) run.explained(problem, out);
  for (const auto& c : planner.candidates()) row.classes += c.alive ? 1 : 0;
  for (int k = 0; k < run.replans && out.status != PlanOutput::Status::kGoalReached; ++k) {
    scene.advance(out.command);
    const double from = run.cpu_ms();
    planner.plan(scene.input, out);
    warm.push_back(run.cpu_ms() - from);
  }
  row.time_ms = medianOf(cold);
  row.warm_ms = medianOf(warm);
  return row;
}

}  // namespace sidestep
