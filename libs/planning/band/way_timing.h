// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/robot_limits.h"
#include "planning/band/obstacle_view.h"

namespace sidestep {

/// When to be where on a given way, among what moves: path and speed taken apart (Kant & Zucker 1986).
///
/// States are cells of the way, a few speeds (the slowest of them backwards, where the robot can) and steps of time.
/// From one step to the next the speed changes by one level at most, which is what the acceleration allows; cells in
/// which the robot would touch something at that time, or half a step before, are left out. All states of a step and a
/// speed are one row of bits, so that a step is a few shifts. The first arrival is the answer: waiting, letting pass
/// and backing off come out of it by themselves.
class WayTiming {
 public:
  struct Query {
    RobotLimits limits;
    double v_start = 0;       ///< [m/s]
    bool stops = true;        ///< at rest at the way's end
    double delay_s = 0;       ///< the robot stands at the start so long before it can go
    double keep_out_m = 0.5;  ///< least distance of the robot's centre to the edge of anything
    double reach_m = 0.8;     ///< what the view was built for
    double horizon_s = 30;    ///< later arrivals are none
    const ObstacleView* obstacles = nullptr;
  };

  /// Distance between the points of the way that `search` wants [m].
  static double spacing(const RobotLimits& limits);

  /// Whether the way's end can be reached. @param points evenly spaced  @param start index of the one where the robot
  /// is
  bool search(std::span<const mrpt::math::TPoint2D> points, int start, const Query& query);
  /// Of the drive found, from when the robot can go [s].
  double duration() const { return static_cast<double>(speeds_.size() - 1) * kStep_s; }
  /// Way done at a time after it can go, negative behind the start [m].
  double wayAt(double t) const;

 private:
  static constexpr double kStep_s = 0.5;
  struct Levels {
    double step = 0;           ///< [m/s]
    int lowest = 0, most = 1;  ///< speeds in steps
  };
  static Levels levelsOf(const RobotLimits& limits);

  uint64_t* reached(int step, int level) {
    const int n = levels_.most - levels_.lowest + 1;
    return &reached_[static_cast<size_t>((step * n + level - levels_.lowest) * words_)];
  }
  void capSpeeds(std::span<const mrpt::math::TPoint2D> points, const Query& query);
  void markClear(std::span<const mrpt::math::TPoint2D> points, const Query& query, double t,
                 std::vector<uint64_t>& out);
  bool standsClear(const mrpt::math::TPoint2D& at, const Query& query) const;
  bool spread(int step);
  bool arrived(int step, bool stops);
  void traceBack(int step);
  /// dst |= src shifted by `by` cells, where `allowed`; @return whether any bit was set
  bool shifted(const uint64_t* src, int by, const uint64_t* allowed, uint64_t* dst) const;

  Levels levels_;
  int cells_ = 0, words_ = 0, start_ = 0, last_speed_ = 0;
  std::vector<uint64_t> reached_, end_, slow_enough_, half_, allowed_;
  std::vector<std::vector<uint64_t>> middles_;  ///< clear cells half way of each step, for tracing back
  std::vector<int> speeds_;                     ///< of the drive found, one a step
  double cell_m_ = 0;
};

}  // namespace sidestep
