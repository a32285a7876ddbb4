// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/planner_driver.h"

#include <algorithm>
#include <vector>

#include "simulation/diff_drive.h"

namespace sidestep {
namespace {

class PlannerDriver final : public Driver {
 public:
  PlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits, PlanWatch watch)
      : planner_(std::move(planner)), limits_(limits), watch_(std::move(watch)) {}

  mrpt::math::TTwist2D drive(const DriverView& view) override {
    PlanInput input;
    input.time_s = view.time_s;
    input.pose = view.pose;
    input.twist = view.twist;
    input.goal = view.goal;
    input.walls = view.walls;
    input.moving = view.moving;
    input.limits = limits_;
    input.period_s = view.period_s;
    if (view.delay_s > 0) lookAhead(view, input);
    planner_->plan(input, out_);
    if (watch_) watch_(input, out_);
    return out_.command;
  }

 private:
  /// What is ordered now shows after `delay_s`: plans from there. Until then the base goes on about as it moves and was
  /// ordered, and what it was ordered it will do; a window around how it moves now would hardly let it speed up.
  void lookAhead(const DriverView& view, PlanInput& input) {
    const double v = 0.5 * (view.twist.vx + view.ordered.vx), w = 0.5 * (view.twist.omega + view.ordered.omega);
    input.pose = alongArc(view.pose, v * view.delay_s, w * view.delay_s);
    input.twist = view.ordered;
    moving_.assign(view.moving.begin(), view.moving.end());
    for (MovingObstacle& m : moving_)
      if (m.predicted.empty()) m.position += m.velocity * view.delay_s;
    input.moving = moving_;
  }

  std::unique_ptr<LocalPlanner> planner_;
  RobotLimits limits_;
  PlanWatch watch_;
  PlanOutput out_;
  std::vector<MovingObstacle> moving_;
};

}  // namespace

std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                          PlanWatch watch) {
  return std::make_unique<PlannerDriver>(std::move(planner), limits, std::move(watch));
}

DriverFactory plannerDrivers(const LocalPlannerParams& params) {
  return [params](const std::string& name, const RobotLimits& limits) -> std::unique_ptr<Driver> {
    if (name == "straight" || name == "stand") return makeSimpleDriver(name, limits);
    return makePlannerDriver(makeLocalPlanner(name, params), limits);
  };
}

bool isLocalPlanner(const std::string& name) {
  const auto names = localPlannerNames();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace sidestep
