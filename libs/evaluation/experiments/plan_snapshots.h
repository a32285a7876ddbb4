// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "evaluation/experiments/world_scenario.h"
#include "figures/snapshot_figure.h"

namespace sidestep {

/// Runs a world until the last of `times_s`, or to its end, and looks at the first plan from each of them on. The plans
/// are those of a run that is not looked at.
/// @param times_s  not decreasing
/// @return none if the robot under test has no local planner
std::vector<PlanSnapshot> takeSnapshots(const WorldScenario& scenario, uint64_t seed, const WorldInputs& inputs,
                                        const std::vector<double>& times_s);

}  // namespace sidestep
