// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_limits.h"

namespace sidestep {

void RobotLimits::visit(ParamVisitor& v) {
  v.number("radius_m", radius_m, {0.01, 10}, "m", "radius of the disc that holds the robot");
  v.number("v_max", v_max, {0.001, 50}, "m/s", "largest speed forwards");
  v.number("v_reverse", v_reverse, {0, 50}, "m/s", "largest speed backwards; 0: never");
  v.number("w_max", w_max, {0.001, 50}, "rad/s", "largest turn rate");
  v.number("accel", accel, {0.001, 100}, "m/s^2", "largest acceleration");
  v.number("brake", brake, {0.001, 100}, "m/s^2", "largest deceleration");
  v.number("turn_accel", turn_accel, {0.001, 100}, "rad/s^2", "largest turn acceleration");
  v.number("track_m", track_m, {0.01, 10}, "m", "distance between the wheels");
  v.number("wheel_speed_max", wheel_speed_max, {0.001, 1e9}, "m/s", "largest speed of either wheel's rim");
}

}  // namespace sidestep
