// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "core/obstacles.h"
#include "core/robot_limits.h"

namespace sidestep {

/// What a driver knows when it is asked. Points and poses are in the map frame.
struct DriverView {
  double time_s = 0;
  mrpt::math::TPose2D pose;    ///< the true one
  mrpt::math::TTwist2D twist;  ///< base frame
  mrpt::math::TPose2D goal;
  std::span<const Segment> walls;
  std::span<const MovingObstacle> moving;  ///< as far as perceived
  double period_s = 0.05;
  mrpt::math::TTwist2D ordered;  ///< what it ordered last
  double delay_s = 0;            ///< by which the base is behind its orders
};

/// Who drives a robot of the world. The simulation knows no planners: whoever makes the world hands drivers in, for
/// example a local planner behind this door.
class Driver {
 public:
  virtual ~Driver() = default;
  /// The velocity to order now, in the base frame.
  virtual mrpt::math::TTwist2D drive(const DriverView& view) = 0;
};

/// Makes the driver that a scenario names. @throws ConfigError for a name it does not know.
using DriverFactory = std::function<std::unique_ptr<Driver>(const std::string& planner, const RobotLimits& limits)>;

/// The two drivers that need no planner: `straight`, which turns towards the goal, goes there and stops, whatever is in
/// the way, and `stand`.
std::unique_ptr<Driver> makeSimpleDriver(const std::string& planner, const RobotLimits& limits);

}  // namespace sidestep
