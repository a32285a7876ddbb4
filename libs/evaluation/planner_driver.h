// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "planning/planners.h"
#include "simulation/driver.h"

namespace sidestep {

/// Is told what a planner was asked and what it answered, once a control period.
using PlanWatch = std::function<void(const PlanInput&, const PlanOutput&)>;

/// A local planner at the wheel of a simulated robot: goes straight for the goal with what is perceived. Where the base
/// is behind its orders (lag, latency), it plans from where the robot will be by then.
std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                          PlanWatch watch = {});

/// Makes the drivers of a world's robots: local planners by name, and what `makeSimpleDriver` makes. They know what the
/// world lets them perceive, and nothing else. The factory may outlive `params`.
/// @throws ConfigError when called with a name that is neither, with all names
DriverFactory plannerDrivers(const LocalPlannerParams& params);

/// Whether a driver of that name is a local planner, with plans that can be watched.
bool isLocalPlanner(const std::string& name);

}  // namespace sidestep
