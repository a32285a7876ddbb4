// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TTwist2D.h>

#include "core/robot_limits.h"

namespace sidestep {

/// The twist nearest to (v, w) that the robot may be ordered: inside its speed limits, its wheels' too (2.37), (2.38),
/// and reachable from `now` within `period_s`. A robot that is beyond its speed limits comes back to them at once; what
/// is not finite counts as 0.
mrpt::math::TTwist2D allowedCommand(double v, double w, const mrpt::math::TTwist2D& now, const RobotLimits& limits,
                                    double period_s);

}  // namespace sidestep
