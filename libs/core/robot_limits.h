// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/params.h"

namespace sidestep {

/// What a differential-drive base is and can do.
struct RobotLimits {
  double radius_m = 0.3;         ///< of the disc that holds the robot [m]
  double v_max = 1.0;            ///< forwards [m/s]
  double v_reverse = 0.2;        ///< backwards, as a positive number [m/s]
  double w_max = 2.5;            ///< [rad/s]
  double accel = 0.5;            ///< [m/s^2]
  double brake = 0.5;            ///< [m/s^2], positive
  double turn_accel = 0.5;       ///< [rad/s^2]
  double track_m = 0.4;          ///< between the wheels [m]
  double wheel_speed_max = 1e9;  ///< of either wheel's rim [m/s]; (2.1)-(2.2) tie it to v and w

  void visit(ParamVisitor& v);
};

}  // namespace sidestep
