// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

namespace sidestep {

class DistanceField;

/// What path.png shows: paths on the part of the map that they cross, all in the map frame [m].
struct PathFigure {
  struct Line {
    std::string name;
    std::vector<mrpt::math::TPose2D> poses;
  };
  std::string title;
  const DistanceField* field = nullptr;  ///< obstacles dark, what is closer to them than `clearance_m` light
  double clearance_m = 0;
  mrpt::math::TPose2D start, goal;
  std::vector<Line> lines;
};

/// Draws the figure with gnuplot; same figure, same bytes. @throws Error (internal) if it cannot be run.
void drawPaths(const PathFigure& figure, const std::string& png_file);

}  // namespace sidestep
