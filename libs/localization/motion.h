// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include "core/params.h"

namespace sidestep {

/// What the wheels (and the gyro) say of one stretch of time: (2.2) with noise.
struct MotionStep {
  double dt_s = 0;              ///< [s], >= 0
  double distance_m = 0;        ///< arc length travelled, negative backwards [m]
  double turn_rad = 0;          ///< turn, counter-clockwise [rad]
  double distance_var = 0;      ///< variance of distance_m [m^2]
  double turn_var = 0;          ///< variance of turn_rad, correlated with nothing else [rad^2]
  bool turn_from_gyro = false;  ///< the gyro's bias applies to turn_rad
  bool still = false;           ///< the robot stands: nothing moves, nothing grows

  /// The first part of the step, `fraction` of it in [0, 1]; noise splits with time.
  MotionStep part(double fraction) const;
};

/// The noise of odometry: (3.2) and the final turn of (3.6).
///
///   sd_v = a1 |v| + a2 |w|,   sd_w = a3 |v| + a4 |w|,   sd_gamma = a5 |v| + a6 |w|
///
/// With `noise_period_s` = 0 each step draws its own noise, as printed: what the covariance grows to then depends on
/// the odometry's rate. With T > 0 the sd are those of averages over T seconds, and the growth is the same at any rate.
struct MotionNoiseParams {
  double a1 = 0.05, a2 = 0.01, a3 = 0.02, a4 = 0.05, a5 = 0, a6 = 0;
  double noise_period_s = 1.0;
  double turn_floor = 0.002;

  void visit(ParamVisitor& v);
  /// Fills the variances of `step` from its speeds.
  void apply(MotionStep& step) const;
};

/// (3.7) without noise: the pose after the step, heading not wrapped.
mrpt::math::TPose2D moved(const mrpt::math::TPose2D& pose, const MotionStep& step);

}  // namespace sidestep
