// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_controllers.h"

namespace sidestep {
namespace {

class NavigatorController final : public Controller {
 public:
  NavigatorController(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                      const LocalNavigatorParams& params, PlanWatch watch)
      : navigator_(std::move(planner), limits, params, std::move(watch)) {}

  mrpt::math::TTwist2D command(const ControlInput& now) override {
    return navigator_.command(
        {now.time_s, now.pose, now.twist, now.goal, now.walls, now.moving, now.period_s, now.commanded, now.delay_s});
  }

 private:
  LocalNavigator navigator_;
};

}  // namespace

std::unique_ptr<Controller> makeNavigatorController(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                                    const LocalNavigatorParams& params, PlanWatch watch) {
  return std::make_unique<NavigatorController>(std::move(planner), limits, params, std::move(watch));
}

ControllerFactory navigatorControllers(const LocalNavigatorParams& params) {
  return [params](const std::string& name, const RobotLimits& limits) {
    return makeNavigatorController(makeLocalPlanner(name, params.planners), limits, params);
  };
}

}  // namespace sidestep
