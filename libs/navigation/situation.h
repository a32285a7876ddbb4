// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <span>

#include "core/obstacles.h"

namespace sidestep {

/// What is known of a robot and of what is around it, at one instant. Points and poses are in the map frame; spans are
/// valid for the call that gets them.
struct Situation {
  double time_s = 0;
  mrpt::math::TPose2D pose;    ///< [m, rad]
  mrpt::math::TTwist2D twist;  ///< base frame: vx [m/s], omega [rad/s]
  mrpt::math::TPose2D goal;
  std::span<const Segment> walls;
  std::span<const MovingObstacle> moving;  ///< as far as perceived
  double period_s = 0.05;                  ///< until the next command
  mrpt::math::TTwist2D commanded;          ///< the last command
  double delay_s = 0;                      ///< by which the base lags behind its commands
};

}  // namespace sidestep
