// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <string>
#include <vector>

namespace sidestep {

/// bands.png: cold plans of up to nine problems beside each other.
struct BandFigure {
  using Line = std::vector<mrpt::math::TPoint2D>;
  struct Panel {
    std::string title;
    std::vector<mrpt::math::TPoint2D> obstacles;
    std::vector<Line> others, chosen;  ///< bands
  };
  double radius_m = 0.2;  ///< of the robot, drawn around each obstacle
  std::vector<Panel> panels;
};

/// Obstacles grey, all bands dark grey, the chosen one red. @throws Error (internal) if gnuplot does not run
void drawBands(const BandFigure& figure, const std::string& png_file);

}  // namespace sidestep
