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

double BandMaker::headingAt(double s, double near) const {
  const double h = std::max(0.1, 0.02 * length_.back());
  const auto a = pointAt(s - h), b = pointAt(s + h);
  return nearestAngle(std::atan2(b.y - a.y, b.x - a.x), near);
}

/// The start, and a turn on the spot if the way goes off to the side or backwards.
void BandMaker::begin(const BandStart& spec, const RobotLimits& limits, Band& out) const {
  out.clear();
  out.push_back({spec.start.x, spec.start.y, spec.start.phi, 0});
  const double off = headingAt(0, spec.start.phi) - spec.start.phi;
  if (std::abs(off) > kSpot_rad && std::abs(spec.ends.v) < 0.3) addTurn(out, off, spec.interval_s, limits);
}

template <class Profile>
void BandMaker::follow(const Profile& profile, const BandStart& spec, const RobotLimits& limits, Band& out) const {
  const double started = out.back().t, back_c = std::cos(out.back().theta), back_s = std::sin(out.back().theta);
  const int n = std::clamp(static_cast<int>(std::lround(profile.duration() / spec.interval_s)), 3, spec.poses_max - 2);
  for (int k = 1; k <= n; ++k) {
    const double t = profile.duration() * k / n, s = profile.wayAt(t);
    const auto p = pointAt(s);
    out.push_back({p.x, p.y, headingAt(std::max(s, 0.0), out.back().theta), started + std::max(t, 0.02 * k)});
    if (s >= 0) continue;
    out.back().x += s * back_c;
    out.back().y += s * back_s;
    out.back().theta = out[out.size() - 2].theta;
  }
  out.back().x = spec.goal.x;
  out.back().y = spec.goal.y;
  if (spec.goal_heading_free) return;
  const double last = nearestAngle(spec.goal.phi, out.back().theta);
  if (std::abs(last - out.back().theta) > kSpot_rad) addTurn(out, last - out.back().theta, spec.interval_s, limits);
  out.back().theta = last;
}

void BandMaker::along(std::span<const mrpt::math::TPoint2D> way, const BandStart& spec, const RobotLimits& limits,
                      Band& out) {
  smooth(way);
  begin(spec, limits, out);
  follow(SpeedProfile(length_.back(), spec.ends.v, limits, spec.ends.goal_stops), spec, limits, out);
}

bool BandMaker::alongWhenClear(std::span<const mrpt::math::TPoint2D> way, const BandStart& spec, WayTiming::Query query,
                               Band& out) {
  constexpr double kBehind_m = 1.5;
  constexpr int kCellsMost = 2000;
  smooth(way);
  begin(spec, query.limits, out);
  const double cell = WayTiming::spacing(query.limits), c = std::cos(out.back().theta), s = std::sin(out.back().theta);
  const int behind = query.limits.v_reverse > 0 ? static_cast<int>(kBehind_m / cell) : 0;
  const int ahead = std::clamp(static_cast<int>(std::lround(length_.back() / cell)), 1, kCellsMost);
  cells_.clear();
  for (int i = -behind; i <= ahead; ++i) {
    auto p = pointAt(i * cell);
    if (i < 0) p = p + mrpt::math::TPoint2D(c, s) * (i * cell);
    cells_.push_back(p);
  }
  query.v_start = spec.ends.v;
  query.stops = spec.ends.goal_stops;
  query.delay_s = out.back().t;
  if (!timing_.search(cells_, behind, query)) return false;
  follow(timing_, spec, query.limits, out);
  return true;
}

}  // namespace sidestep
