// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <string>
#include <vector>

#include "core/obstacles.h"

namespace sidestep {

/// One who moved, with the places at evenly spaced times (every `WorldFigure::period_s`); not finite: not there.
struct MovingPath {
  std::string name;
  double radius_m = 0.3;
  bool is_robot = false;  ///< the one under test: drawn thick
  std::vector<mrpt::math::TPoint2D> places;
};

/// Who went where in a world, as figures 4.4 and 4.5 of the dissertation show it: time is colour.
struct WorldFigure {
  std::string title;
  double period_s = 0.1;
  std::vector<Segment> walls;
  std::vector<MovingPath> paths;
  mrpt::math::TPoint2D goal;
};

/// Draws all paths, with a disc every few seconds. @throws Error (internal) with gnuplot's message if it cannot be run.
void drawWorld(const WorldFigure& figure, const std::string& png_file);

/// Films it: one picture a period, `speed` times real time. Pictures go to `frames_folder`, which must exist.
/// @throws Error (internal) if gnuplot or ffmpeg are not installed, or with what they wrote.
void filmWorld(const WorldFigure& figure, const std::string& frames_folder, const std::string& mp4_file);

/// @throws ConfigError if ffmpeg is not installed.
void requireFfmpeg();

}  // namespace sidestep
