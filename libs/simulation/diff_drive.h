// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <deque>

#include "core/params.h"
#include "core/random.h"
#include "core/robot_limits.h"
#include "simulation/sensor_errors.h"

namespace sidestep {

/// How a base answers to what it is told.
struct DriveParams {
  double latency_s = 0;
  double lag_s = 0;
  double slip_mean = 0, slip_sd = 0, slip_correlation_s = 0.5;
  double timeout_s = 0;

  void visit(ParamVisitor& v);
};

/// A differential-drive base. What is ordered arrives `latency_s` later, is cut to the limits, is approached by a
/// first-order lag of each wheel (`lag_s`) within the limits of acceleration; the wheels slip, each for itself. The
/// pose follows the exact arc of each step's mean speeds (2.1)-(2.2).
class DiffDrive {
 public:
  DiffDrive(const DriveParams& params, const RobotLimits& limits, const mrpt::math::TPose2D& start, Random random);

  /// Moves at so much already [m/s].
  void startAt(double v) { v_ = ground_v_ = target_v_ = v; }
  /// vx [m/s] and omega [rad/s] ordered at `time_s`; times must not decrease.
  void order(double time_s, const mrpt::math::TTwist2D& command);
  /// Goes on by `dt_s` to `time_s`.
  void step(double time_s, double dt_s);
  /// Puts it back where it was before the last step, standing: something is in the way. It may still turn.
  void block(const mrpt::math::TPose2D& before);

  const mrpt::math::TPose2D& pose() const { return pose_; }
  /// Over the ground, in the base frame.
  mrpt::math::TTwist2D twist() const { return {ground_v_, 0, ground_w_}; }
  /// What is aimed at now: the order that has arrived, within the limits.
  mrpt::math::TTwist2D target() const { return {target_v_, 0, target_w_}; }
  /// What the wheels turned by in the last step, as way and turn: what encoders see.
  double wheelDistance() const { return wheel_distance_; }
  double wheelTurn() const { return wheel_turn_; }

 private:
  struct Order {
    double from_s, v, w;
  };
  void aim(double time_s);
  double ramped(double now, double wanted, double up, double down, double dt_s) const;

  DriveParams params_;
  RobotLimits limits_;
  mrpt::math::TPose2D pose_;
  Random random_;
  CorrelatedError left_slip_, right_slip_;
  std::deque<Order> orders_;
  double last_order_s_ = 0;
  double target_v_ = 0, target_w_ = 0, v_ = 0, w_ = 0, ground_v_ = 0, ground_w_ = 0;
  double wheel_distance_ = 0, wheel_turn_ = 0;
};

}  // namespace sidestep
