// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TTwist2D.h>

#include <string>
#include <vector>

#include "core/reading.h"

namespace sidestep {

/// How a robot does.
struct RobotHealth {
  bool drivable = true;       ///< false: commands have no effect
  std::string problem;        ///< what is wrong, in plain words; "" on a good day
  double last_reading_s = 0;  ///< time stamp of the newest reading, 0 before the first [Unix s]
};

/// A robot, simulated or real: readings come out, velocities go in. The navigator cannot tell them apart.
///
/// Calls come from one thread. A base stops by itself when `drive` has not been called for its watchdog's time.
class RobotPort {
 public:
  virtual ~RobotPort() = default;
  /// Appends all readings since the last call, in the order in which they came. Never blocks.
  virtual void read(std::vector<Reading>& readings) = 0;
  /// The velocity to hold until the next call, in the base frame: vx [m/s], omega [rad/s]. A value that is not finite
  /// counts as 0.
  virtual void drive(const mrpt::math::TTwist2D& command) = 0;
  /// Stands as soon as the base can.
  virtual void stop() noexcept = 0;
  virtual RobotHealth health() const = 0;
};

}  // namespace sidestep
