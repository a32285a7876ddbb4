// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_control.h"

namespace sidestep {

WorldControl::WorldControl(const WorldParams& params, const ControllerFactory& factory)
    : period_s_(params.control_period_s) {
  for (const auto& name : params.robot_names) {
    const RobotParams& robot = params.robots.at(name);
    delays_s_.push_back(robot.drive.latency_s + robot.drive.lag_s);
    controllers_.push_back(factory ? factory(robot.planner, robot.limits) : nullptr);
  }
}

void WorldControl::setController(size_t robot, std::unique_ptr<Controller> controller) {
  controllers_[robot] = std::move(controller);
}

std::optional<mrpt::math::TTwist2D> WorldControl::command(size_t robot, double time_s, const WorldPhysics& world,
                                                          const WorldPerception& perception) {
  if (!controllers_[robot]) return std::nullopt;
  const RobotState& s = world.robots()[robot];
  if (s.arrived) return mrpt::math::TTwist2D(0, 0, 0);
  return controllers_[robot]->command({time_s, s.pose, s.twist, s.goal, world.walls().walls(), perception.of(robot),
                                       period_s_, s.command, delays_s_[robot]});
}

}  // namespace sidestep
