// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <string>
#include <vector>

#include "core/params.h"

namespace sidestep {

/// A motion v(t), w(t), without any error in it.
///
///   sinusoid:  v(t) = v,  w(t) = w_mean + w_amplitude sin(w_frequency t + w_phase)
///   circle:    v(t) = v,  w(t) = 2 v / diameter
///   table:     v and w linear between rows of (t, v, w), constant before the first and after the last
struct TrajectoryParams {
  std::string kind = "circle";
  double duration_s = 63;
  double step_s = 0.01;
  double x_m = 0, y_m = 0, yaw = 0;                                    // the start
  double v = 2;                                                        // m/s
  double diameter_m = 40;                                              // negative: clockwise
  double w_mean = 0, w_amplitude = 0, w_frequency = 0.4, w_phase = 0;  // rad/s, rad/s, rad/s, rad
  Table profile;                                                       // t, v, w

  void visit(ParamVisitor& v);
  /// @throws ConfigError if the times of the table do not grow, or the table is missing.
  void check() const;
};

/// Where the robot truly is, and how it truly moves.
struct TruthSample {
  double time_s = 0;
  mrpt::math::TPose2D pose;  ///< map frame [m, rad], yaw in [-pi, pi)
  double v = 0, w = 0;       ///< at this instant [m/s, rad/s]
  double distance_m = 0;     ///< travelled since the sample before, negative backwards [m]
  double turn_rad = 0;       ///< turned since the sample before, not wrapped [rad]
};

/// The motion sampled at 0, step, 2 step, ... up to the duration. Heading and distance are integrals in closed form,
/// the position is integrated by Gauss's five points a step (splitting steps at the table's rows), so that it is exact
/// to rounding.
std::vector<TruthSample> sampleTrajectory(const TrajectoryParams& params);

}  // namespace sidestep
