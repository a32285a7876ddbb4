// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/experiments/world_scenario.h"

namespace sidestep {

/// The robot under test, those around it, and what its planner considered, at one time.
struct PlanSnapshot {
  struct Line {
    std::vector<mrpt::math::TPoint2D> points;
    bool chosen = false;
  };
  double time_s = 0;
  mrpt::math::TPose2D robot;
  double radius_m = 0;
  mrpt::math::TPoint2D goal;
  std::vector<MovingObstacle> others;  ///< as they truly are
  std::vector<mrpt::math::TPoint2D> driven;
  std::vector<Line> candidates;
  std::string reason;  ///< as PlanOutput::reason
};

/// The snapshots of one run, in the order of time.
struct SnapshotColumn {
  std::string title;
  std::vector<PlanSnapshot> snapshots;
};

/// Runs a world until the last of `times_s`, or to its end, and looks at the first plan from each of them on. The plans
/// are those of a run that is not looked at.
/// @param times_s  not decreasing
/// @return none if the robot under test has no local planner
std::vector<PlanSnapshot> takeSnapshots(const WorldScenario& scenario, uint64_t seed, const WorldInputs& inputs,
                                        const std::vector<double>& times_s);

/// Draws them: a column a planner, a row a time, as figures 4.13 and 4.18 of the dissertation. Candidates thin and
/// green, the chosen one thick and red, people with an arrow of one second of their velocity.
/// @throws Error (internal) with gnuplot's message if it cannot be run.
void drawSnapshots(const std::vector<SnapshotColumn>& columns, std::span<const Segment> walls,
                   const std::string& png_file);

}  // namespace sidestep
