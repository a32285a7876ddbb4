// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/planner_driver.h"

namespace sidestep {
namespace {

class PlannerDriver final : public Driver {
 public:
  PlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits) : planner_(std::move(planner)) {
    input_.limits = limits;
  }
  mrpt::math::TTwist2D drive(const DriverView& view) override {
    input_.time_s = view.time_s;
    input_.pose = view.pose;
    input_.twist = view.twist;
    input_.goal = view.goal;
    input_.walls = view.walls;
    input_.moving = view.moving;
    input_.period_s = view.period_s;
    planner_->plan(input_, output_);
    return output_.command;
  }

 private:
  std::unique_ptr<LocalPlanner> planner_;
  PlanInput input_;
  PlanOutput output_;
};

}  // namespace

std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits) {
  return std::make_unique<PlannerDriver>(std::move(planner), limits);
}

DriverFactory driversOf(PlannerFactory planners) {
  return [planners = std::move(planners)](const std::string& name, const RobotLimits& limits) {
    auto planner = planners ? planners(name) : nullptr;
    return planner ? makePlannerDriver(std::move(planner), limits) : makeSimpleDriver(name, limits);
  };
}

}  // namespace sidestep
