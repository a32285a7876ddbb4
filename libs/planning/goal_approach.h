// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>

#include "planning/local_planner.h"

namespace sidestep {

/// When a robot is where it was sent, and how it gets there: the same for every planner of velocities.
struct GoalParams {
  double tolerance_m = 0.3;
  double tolerance_rad = 0.1;
  double lookahead_m = 2;

  void visit(ParamVisitor& v);
};

/// The (v, w) that the base can reach within the period, inside its limits.
struct ReachableTwists {
  double v_low = 0, v_high = 0, w_low = 0, w_high = 0;
};
/// (2.23) and (2.25): 0 <= v <= v_max, |w| <= w_max, and no more than the accelerations allow from the present twist. A
/// twist that is already beyond the limits comes back to them as fast as the base can.
ReachableTwists reachableTwists(const PlanInput& input);

/// The goal, or a point of the path `lookahead_m` ahead of the point of the path that is nearest to the robot.
mrpt::math::TPoint2D targetPoint(const PlanInput& input, double lookahead_m);

/// The largest speed at which the robot still comes to the goal, at most v_max: it can stop there, sqrt(2 brake d), and
/// it can turn there, w_max d / (2 sin(bearing)), less a fifth for ramps; a goal inside the turning circle would be
/// circled for ever. The latter counts only nearer than the turning radius, so that it costs no time in an encounter
/// before.
double goalSpeed(const PlanInput& input);

/// Clears `out` for a new cycle, keeping its memory.
void beginOutput(PlanOutput& out);

/// Brakes as hard as the base can, saying why. `reason` is a text that lives on.
void brakeFor(const PlanInput& input, const char* reason, PlanOutput& out);

/// Brakes, saying why, where something of the input is not finite. @return whether it did
bool refusesInput(const PlanInput& input, PlanOutput& out);

/// The cycles in which nothing is to be planned: input that is not finite (brakes), the goal reached (stops, after
/// turning to its heading if that matters).
/// @return whether `out` holds the answer
bool answeredAtDoor(const PlanInput& input, const GoalParams& params, PlanOutput& out);

}  // namespace sidestep
