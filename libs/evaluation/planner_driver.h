// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "planning/local_planner.h"
#include "simulation/driver.h"

namespace sidestep {

/// Makes the local planner of that name; null if there is none of that name.
using PlannerFactory = std::function<std::unique_ptr<LocalPlanner>(const std::string& name)>;

/// A local planner at the wheel of a simulated robot: goes straight for the goal with what is perceived.
std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits);

/// Drivers for a world: local planners by `planners`, else the simple ones (straight, stand).
DriverFactory driversOf(PlannerFactory planners);

}  // namespace sidestep
