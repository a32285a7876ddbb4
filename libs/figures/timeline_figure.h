// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace sidestep {

/// Runs of a robot over time, as figures 4.6, 4.7, 4.15 and 4.20 of the dissertation show them.
struct TimelineFigure {
  struct Sample {
    double time_s = 0;
    double delta_min = 0;        ///< (4.6), largest since the sample before
    double v = 0, w = 0;         ///< over the ground [m/s], [rad/s]
    double collision_index = 0;  ///< (4.11), largest since the sample before
  };
  struct Run {
    std::string name;  ///< for the key; with one run only there is none
    std::vector<Sample> samples;
  };
  std::string title;
  double index_threshold = 0;  ///< above it the collision index counts as a collision
  std::vector<Run> runs;
};

/// Draws delta_min(t) of (4.6), the collision index (4.11) with its threshold, speed and turn rate, one below the
/// other, all runs in each.
/// @throws Error (internal) with gnuplot's message if it cannot be run.
void drawTimeline(const TimelineFigure& figure, const std::string& png_file);

}  // namespace sidestep
