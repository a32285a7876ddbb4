// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <Eigen/Core>
#include <vector>

namespace sidestep {

/// Where a moving obstacle will be, some time from now.
struct PredictedState {
  double after_s = 0;                                    ///< from the time of the obstacle's own state [s]
  mrpt::math::TPoint2D position;                         ///< map frame [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position [m^2]
};

/// A disc that moves: a person, another robot.
struct MovingObstacle {
  int id = 0;
  mrpt::math::TPoint2D position;  ///< map frame [m]
  mrpt::math::TPoint2D velocity;  ///< map frame [m/s]
  double radius_m = 0.3;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the position [m^2]
  std::vector<PredictedState> predicted;                 ///< in time order; empty: it goes on straight at its velocity
};

/// A piece of a wall.
struct Segment {
  mrpt::math::TPoint2D a, b;  ///< map frame [m]
};

}  // namespace sidestep
