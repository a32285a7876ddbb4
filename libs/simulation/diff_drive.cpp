// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/diff_drive.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {

void DriveParams::visit(ParamVisitor& v) {
  v.number("latency_s", latency_s, {0, 5}, "s", "from an order to its first effect");
  v.number("lag_s", lag_s, {0, 5}, "s", "time constant with which each wheel follows");
  v.number("slip_mean", slip_mean, {0, 0.9}, "", "share of each wheel's way that is lost");
  v.number("slip_sd", slip_sd, {0, 0.5}, "", "sd of that");
  v.number("slip_correlation_s", slip_correlation_s, {0, 3600}, "s", "time over which slip stays alike");
  v.number("timeout_s", timeout_s, {0, 60}, "s", "without orders for this long the base stops; 0: never");
}

DiffDrive::DiffDrive(const DriveParams& params, const RobotLimits& limits, const mrpt::math::TPose2D& start,
                     Random random)
    : params_(params),
      limits_(limits),
      pose_(start),
      random_(random),
      left_slip_(params.slip_sd, params.slip_correlation_s),
      right_slip_(params.slip_sd, params.slip_correlation_s) {}

void DiffDrive::order(double time_s, const mrpt::math::TTwist2D& command) {
  const bool finite = std::isfinite(command.vx) && std::isfinite(command.omega);
  orders_.push_back({time_s + params_.latency_s, finite ? command.vx : 0, finite ? command.omega : 0});
  last_order_s_ = time_s;
}

/// The newest order that has arrived, scaled down so that neither wheel exceeds its limit.
void DiffDrive::aim(double time_s) {
  while (!orders_.empty() && orders_.front().from_s <= time_s + 1e-9) {
    const Order o = orders_.front();
    orders_.pop_front();
    target_v_ = std::clamp(o.v, -limits_.v_reverse, limits_.v_max);
    target_w_ = std::clamp(o.w, -limits_.w_max, limits_.w_max);
    const double fastest = outerWheelSpeed(target_v_, target_w_, limits_.track_m);
    if (fastest <= limits_.wheel_speed_max) continue;
    target_v_ *= limits_.wheel_speed_max / fastest;
    target_w_ *= limits_.wheel_speed_max / fastest;
  }
  if (params_.timeout_s > 0 && time_s - last_order_s_ > params_.timeout_s) target_v_ = target_w_ = 0;
}

double DiffDrive::ramped(double now, double wanted, double up, double down, double dt_s) const {
  const double lag = params_.lag_s > 0 ? 1 - std::exp(-dt_s / params_.lag_s) : 1;
  const double change = (wanted - now) * lag;
  const bool faster = now * change > 0 || now == 0;
  const double most = (faster ? up : down) * dt_s;
  return now + std::clamp(change, -most, most);
}

void DiffDrive::step(double time_s, double dt_s) {
  aim(time_s - dt_s);
  const double v = ramped(v_, target_v_, limits_.accel, limits_.brake, dt_s);
  const double w = ramped(w_, target_w_, limits_.turn_accel, limits_.turn_accel, dt_s);
  wheel_distance_ = 0.5 * (v_ + v) * dt_s;
  wheel_turn_ = 0.5 * (w_ + w) * dt_s;
  v_ = v, w_ = w;
  WheelMotion rims = wheelsOf({wheel_distance_, wheel_turn_}, limits_.track_m);
  rims.left *= 1 - std::clamp(params_.slip_mean + left_slip_.step(dt_s, random_), -1.0, 1.0);
  rims.right *= 1 - std::clamp(params_.slip_mean + right_slip_.step(dt_s, random_), -1.0, 1.0);
  const BodyMotion ground = bodyOf(rims, limits_.track_m);
  ground_v_ = ground.ahead / dt_s, ground_w_ = ground.turn / dt_s;
  pose_ = alongArc(pose_, ground.ahead, ground.turn);
}

void DiffDrive::block(const mrpt::math::TPose2D& before) {
  pose_.x = before.x, pose_.y = before.y;
  v_ = ground_v_ = 0;
}

}  // namespace sidestep
