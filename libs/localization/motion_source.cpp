// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/motion_source.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

MotionSource::MotionSource(const OdometryParams& odometry, const ImuParams& imu, bool zero_velocity)
    : odometry_(odometry), imu_(imu), zero_velocity_(zero_velocity) {}

void MotionSource::addYawRate(double time_s, double rate) {
  const double t = time_s - imu_.delay_s;
  if (!std::isfinite(t) || !std::isfinite(rate)) return;
  if (!rates_.empty() && t <= rates_.back().time_s) return;  // the sorted log has passed it already
  rates_.push_back({t, rate});
  if (rates_.size() > 100000) rates_.pop_front();
}

std::optional<double> MotionSource::turn(double from_s, double to_s) const {
  const double hold = imu_.yaw_rate == "on" ? 1e9 : imu_.max_yaw_rate_period_s;
  auto next =
      std::upper_bound(rates_.begin(), rates_.end(), from_s, [](double t, const Sample& s) { return t < s.time_s; });
  double t = from_s, sum = 0;
  if (next == rates_.begin()) {
    if (next == rates_.end() || next->time_s - from_s > hold) return std::nullopt;
    t = std::min(next->time_s, to_s);
    sum += (t - from_s) * next->rate;
  }
  while (t < to_s) {
    const bool has_left = next != rates_.begin(), has_right = next != rates_.end();
    const Sample left = has_left ? *std::prev(next) : *next;
    if (!has_right) {
      if (to_s - left.time_s > hold) return std::nullopt;
      return sum + (to_s - t) * left.rate;
    }
    if (has_left && next->time_s - left.time_s > hold) return std::nullopt;
    const double end = std::min(next->time_s, to_s), span = next->time_s - left.time_s;
    auto at = [&](double when) {
      return span > 0 ? left.rate + (next->rate - left.rate) * (when - left.time_s) / span : next->rate;
    };
    sum += 0.5 * (at(t) + at(end)) * (end - t);
    t = end;
    ++next;
  }
  return sum;
}

void MotionSource::forget(double before_s) {
  while (rates_.size() > 1 && rates_[1].time_s < before_s) rates_.pop_front();
}

std::optional<MotionSource::Step> MotionSource::addOdometry(double time_s, const mrpt::obs::CObservationOdometry& o) {
  const auto inc = odometry_.advance(time_s, o);
  if (!inc) return std::nullopt;
  Step out{inc->from_s, inc->to_s, inc->step, inc->T_from_to, std::nullopt};
  const auto gyro = turn(inc->from_s, inc->to_s);
  forget(inc->from_s);
  out.motion.still = zero_velocity_ && inc->step.still;
  if (gyro) {
    const double dt = inc->step.dt_s;
    if (out.motion.still) out.resting_rate = *gyro / dt;
    out.motion.turn_rad = *gyro;
    out.motion.turn_var = imu_.yaw_rate_sd * imu_.yaw_rate_sd * dt;
    out.motion.turn_from_gyro = true;
    // Wheels that do not turn, on a robot that does: it is being pushed, not standing.
    if (std::abs(*gyro) > 0.1 * dt + 1e-9) out.motion.still = false;
  }
  if (out.motion.still) out.motion.turn_rad = 0;
  if (!out.motion.still) out.resting_rate.reset();
  return out;
}

}  // namespace sidestep
