// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "navigation/local_navigator.h"
#include "simulation/controller.h"

namespace sidestep {

/// Where simulation and navigation meet: a local navigator commands a robot of a world, with what the robot perceives.
std::unique_ptr<Controller> makeNavigatorController(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                                    const LocalNavigatorParams& params = {}, PlanWatch watch = {});

/// Makes the controllers of a world's robots: local planners by name. The factory may outlive `params`.
/// @throws ConfigError when called with a name that is none, with all names
ControllerFactory navigatorControllers(const LocalNavigatorParams& params = {});

}  // namespace sidestep
