// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sidestep {

/// NIS of one sensor along a run, in bounded memory: points for the eye, thinned evenly, and means over blocks.
class NisTrack {
 public:
  struct Point {
    double time_s = 0, value = 0;
    bool accepted = true;
  };
  struct Block {
    double from_s = 0, to_s = 0, sum = 0;
    uint64_t count = 0;
  };
  void add(double time_s, double nis, int dof, bool accepted);

  const std::vector<Point>& points() const { return points_; }
  /// Of the accepted ones: between 20 and 40 blocks of about the same number once there are that many.
  const std::vector<Block>& blocks() const { return blocks_; }
  int dof() const { return dof_; }

 private:
  std::vector<Point> points_;
  std::vector<Block> blocks_;
  uint64_t seen_ = 0, stride_ = 1, block_size_ = 1;
  int dof_ = 0;
};

/// consistency.png: NEES where there is truth and NIS of each sensor over time, a panel each: single values, means over
/// blocks, and the 95 % interval in which those of a consistent filter lie.
struct ConsistencyFigure {
  struct Mean {
    double time_s = 0, mean = 0;
    double low = 0, high = 0;  ///< the 95 % interval
  };
  struct Panel {
    std::string title;
    double expected = 1;  ///< mean of a consistent filter
    std::vector<NisTrack::Point> values;
    std::vector<Mean> means;
  };
  std::string title;
  double start_s = 0;  ///< taken from all times
  std::vector<Panel> panels;
};

/// Draws nothing, and returns false, if there is no panel.
/// @throws Error if gnuplot fails.
bool drawConsistency(const ConsistencyFigure& figure, const std::string& png_file);

}  // namespace sidestep
