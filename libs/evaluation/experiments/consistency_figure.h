// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "evaluation/metrics/normalized_errors.h"

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

/// consistency.png: NEES over time where there is truth, NIS of each sensor over time; single values, means over
/// blocks, and the 95 % band in which those of a consistent filter lie.
struct ConsistencyFigure {
  struct Sensor {
    std::string label;
    NisTrack track;
    double gate_probability = 1;
    double independent = 1;  ///< share of the measurements that are worth one of their own
    std::string verdict;
  };
  std::string title;
  double start_s = 0;  ///< taken from all times
  NormalizedErrors errors;
  std::string verdict;  ///< of the errors
  std::vector<Sensor> sensors;
};

/// Draws nothing, and returns false, if there is nothing to draw.
/// @throws Error if gnuplot fails.
bool drawConsistency(const ConsistencyFigure& figure, const std::string& png_file);

}  // namespace sidestep
