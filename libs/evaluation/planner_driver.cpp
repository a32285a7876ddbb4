// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/planner_driver.h"

namespace sidestep {
namespace {

class PlannerDriver final : public Driver {
 public:
  PlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits)
      : planner_(std::move(planner)), limits_(limits) {}

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
    planner_->plan(input, out_);
    return out_.command;
  }

 private:
  std::unique_ptr<LocalPlanner> planner_;
  RobotLimits limits_;
  PlanOutput out_;
};

}  // namespace

std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits) {
  return std::make_unique<PlannerDriver>(std::move(planner), limits);
}

DriverFactory plannerDrivers(const LocalPlannerParams& params) {
  return [params](const std::string& name, const RobotLimits& limits) -> std::unique_ptr<Driver> {
    if (name == "straight" || name == "stand") return makeSimpleDriver(name, limits);
    return makePlannerDriver(makeLocalPlanner(name, params), limits);
  };
}

}  // namespace sidestep
