// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <vector>

#include "planning/local_planner.h"

namespace sidestep {

/// Where the band of this plan is to end.
struct LocalGoal {
  mrpt::math::TPose2D pose;
  bool is_goal = true;                    ///< the goal itself; else a point of the global path, which is driven through
  bool heading_free = true;               ///< `pose.phi` is a first guess only
  std::vector<mrpt::math::TPoint2D> way;  ///< along the global path, from the robot to `pose`; empty without a path
};

/// Goes `horizon_m` ahead along the global path from the point of it that is nearest to the robot. Without a path the
/// goal itself.
void findLocalGoal(const PlanInput& input, double horizon_m, LocalGoal& out);

}  // namespace sidestep
