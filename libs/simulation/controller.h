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

/// What a controller knows when it is asked. Points and poses are in the map frame.
struct ControlInput {
  double time_s = 0;
  mrpt::math::TPose2D pose;    ///< the true one
  mrpt::math::TTwist2D twist;  ///< base frame
  mrpt::math::TPose2D goal;
  std::span<const Segment> walls;
  std::span<const MovingObstacle> moving;  ///< as far as perceived
  double period_s = 0.05;
  mrpt::math::TTwist2D commanded;  ///< the last command
  double delay_s = 0;              ///< by which the base lags behind its commands
};

/// Who commands a robot of the world. The simulation knows no planners: whoever makes the world hands controllers in,
/// for example a local planner behind this door.
class Controller {
 public:
  virtual ~Controller() = default;
  /// The velocity to command now, in the base frame.
  virtual mrpt::math::TTwist2D command(const ControlInput& now) = 0;
};

/// Makes the controller that a scenario names as a robot's planner; null: the robot moves by `World::command` alone.
/// @throws ConfigError for a name it does not know.
using ControllerFactory =
    std::function<std::unique_ptr<Controller>(const std::string& planner, const RobotLimits& limits)>;

}  // namespace sidestep
