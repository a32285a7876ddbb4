// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band_start.h"

#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

constexpr double kSpot_rad = 1.2;  ///< a larger turn than this is made on the spot
constexpr double kDense_m = 0.15;  ///< spacing of the way while it is smoothed
constexpr int kSmoothings = 15;

/// Shortest time to turn by `angle` from rest to rest.
double turnTime(double angle, const RobotLimits& limits) {
  const double way = std::abs(angle), ramp = limits.w_max * limits.w_max / limits.turn_accel;
  return way < ramp ? 2 * std::sqrt(way / limits.turn_accel) : way / limits.w_max + limits.w_max / limits.turn_accel;
}

/// Adds poses that turn on the spot, from rest to rest, with equal times.
void addTurn(Band& band, double angle, double interval_s, const RobotLimits& limits) {
  const BandPose from = band.back();
  const double time = std::max(turnTime(angle, limits), interval_s);
  const int n = std::max(2, static_cast<int>(std::lround(time / interval_s)));
  for (int k = 1; k <= n; ++k) {
    const double share = static_cast<double>(k) / n;
    const double done = share < 0.5 ? 2 * share * share : 1 - 2 * (1 - share) * (1 - share);
    band.push_back({from.x, from.y, from.theta + done * angle, from.t + share * time});
  }
}

}  // namespace

double nearestAngle(double angle, double near) { return near + std::remainder(angle - near, 2 * M_PI); }

void BandMaker::smooth(std::span<const mrpt::math::TPoint2D> way) {
  points_.assign(way.begin(), way.end());
  const auto measure = [this] {
    length_.assign(1, 0);
    for (size_t i = 0; i + 1 < points_.size(); ++i)
      length_.push_back(length_.back() + std::hypot(points_[i + 1].x - points_[i].x, points_[i + 1].y - points_[i].y));
  };
  measure();
  const int n = std::clamp(static_cast<int>(length_.back() / kDense_m), 2, 400);
  dense_.clear();
  for (int i = 0; i <= n; ++i) dense_.push_back(pointAt(length_.back() * i / n));
  points_ = dense_;
  for (int k = 0; k < kSmoothings; ++k)
    for (size_t i = 1; i + 1 < points_.size(); ++i)
      points_[i] = (points_[i - 1] + points_[i] * 2 + points_[i + 1]) * 0.25;
  measure();
}

mrpt::math::TPoint2D BandMaker::pointAt(double s) const {
  const auto above = std::upper_bound(length_.begin(), length_.end(), s);
  const auto at =
      std::clamp<std::ptrdiff_t>(above - length_.begin() - 1, 0, static_cast<std::ptrdiff_t>(length_.size()) - 2);
  const auto i = static_cast<size_t>(at);
  const double part = length_[i + 1] - length_[i];
  const double share = part > 0 ? std::clamp((s - length_[i]) / part, 0.0, 1.0) : 0;
  return points_[i] + (points_[i + 1] - points_[i]) * share;
}

void BandMaker::along(std::span<const mrpt::math::TPoint2D> way, const BandStart& spec, const RobotLimits& limits,
                      Band& out) {
  smooth(way);
  const SpeedProfile profile(length_.back(), spec.ends.v, limits, spec.ends.goal_stops);
  const auto headingAt = [&](double s, double near) {
    const double h = std::max(0.1, 0.02 * length_.back());
    const auto a = pointAt(s - h), b = pointAt(s + h);
    return nearestAngle(std::atan2(b.y - a.y, b.x - a.x), near);
  };
  out.clear();
  out.push_back({spec.start.x, spec.start.y, spec.start.phi, 0});
  const double off = headingAt(0, spec.start.phi) - spec.start.phi;
  if (std::abs(off) > kSpot_rad && std::abs(spec.ends.v) < 0.3) addTurn(out, off, spec.interval_s, limits);
  const double started = out.back().t;
  const int n = std::clamp(static_cast<int>(std::lround(profile.duration() / spec.interval_s)), 3, spec.poses_max - 2);
  for (int k = 1; k <= n; ++k) {
    const double t = profile.duration() * k / n, s = profile.wayAt(t);
    const auto p = pointAt(s);
    out.push_back({p.x, p.y, headingAt(s, out.back().theta), started + std::max(t, 0.02 * k)});
  }
  out.back().x = spec.goal.x;
  out.back().y = spec.goal.y;
  if (spec.goal_heading_free) return;
  const double last = nearestAngle(spec.goal.phi, out.back().theta);
  if (std::abs(last - out.back().theta) > kSpot_rad) addTurn(out, last - out.back().theta, spec.interval_s, limits);
  out.back().theta = last;
}

}  // namespace sidestep
