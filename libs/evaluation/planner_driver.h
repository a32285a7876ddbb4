// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "planning/planners.h"
#include "simulation/driver.h"

namespace sidestep {

/// A local planner at the wheel of a simulated robot: goes straight for the goal with what is perceived.
std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits);

/// Makes the drivers of a world's robots: local planners by name, and what `makeSimpleDriver` makes. They know what the
/// world lets them perceive, and nothing else. The factory may outlive `params`.
/// @throws ConfigError when called with a name that is neither, with all names
DriverFactory plannerDrivers(const LocalPlannerParams& params);

}  // namespace sidestep
