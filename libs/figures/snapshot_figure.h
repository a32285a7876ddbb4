// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <span>
#include <string>
#include <vector>

#include "core/obstacles.h"

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

/// Draws them: a column a planner, a row a time, as figures 4.13 and 4.18 of the dissertation. Candidates thin and
/// green, the chosen one thick and red, people with an arrow of one second of their velocity.
/// @throws Error (internal) with gnuplot's message if it cannot be run.
void drawSnapshots(const std::vector<SnapshotColumn>& columns, std::span<const Segment> walls,
                   const std::string& png_file);

}  // namespace sidestep
