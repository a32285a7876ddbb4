// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <optional>
#include <vector>

#include "localization/pose_filter.h"

namespace sidestep {

/// Where the robot starts, as far as it is known.
struct StartParams {
  bool pose_given = false;
  double x_m = 0, y_m = 0, yaw = 0;
  double position_sd_m = 0.05;
  double yaw_sd = 0.02;  // rad
  double align_distance_m = 5;
  double align_time_s = 120;
  double heading_wait_s = 3;

  void visit(ParamVisitor& v);
};

struct StartBelief {
  double time_s = 0;
  PoseBelief belief;
};

/// Finds position and heading at the start of a log from the first stretch of motion: the odometry's track is laid onto
/// the fixes (SE(2) least squares); or, where the IMU knows its heading well enough, from the first fix at once.
class StartAlignment {
 public:
  StartAlignment(const StartParams& params, bool expect_positions, bool expect_heading, double heading_offset_sd);

  void begin(double time_s);
  /// Odometry moved; `T_start_base` is its track since begin().
  void track(double time_s, const mrpt::math::TPose2D& T_start_base);
  void fix(const Measurement& m);
  void heading(const Measurement& m);
  /// The start, once it is known well enough; with `last_chance`, as well as it can be known now.
  std::optional<StartBelief> solve(bool last_chance) const;

 private:
  struct Pair {
    mrpt::math::TPoint2D track, fix;
    double variance;
  };
  PoseBelief given() const;
  PoseBelief atOrigin() const;
  std::optional<PoseBelief> fromHeading() const;
  std::optional<PoseBelief> fromTrack(bool last_chance) const;

  StartParams params_;
  bool expect_positions_, expect_heading_;
  double heading_offset_sd_;
  std::optional<double> begin_s_, heading_;
  double heading_var_ = 0, now_s_ = 0;
  mrpt::math::TPose2D T_start_base_;
  std::optional<mrpt::math::TPose2D> heading_track_;
  std::vector<Pair> pairs_;
};

}  // namespace sidestep
