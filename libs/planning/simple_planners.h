// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "planning/local_planner.h"

namespace sidestep {

/// Planners for comparisons, which look at nothing. They order the speed that they want at once, within the limits of
/// speed: ramps are left to the base.

/// Turns towards the goal, goes there and stops, whatever is in the way.
std::unique_ptr<LocalPlanner> makeStraightPlanner();
/// Stands.
std::unique_ptr<LocalPlanner> makeStandPlanner();

}  // namespace sidestep
