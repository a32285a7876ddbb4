// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/way_timing.h"

#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

constexpr int kLevelsMost = 8;
constexpr int kBits = 64;

void setBit(std::vector<uint64_t>& bits, int i) { bits[static_cast<size_t>(i / kBits)] |= uint64_t{1} << (i % kBits); }
bool bitOf(const uint64_t* bits, int i) { return (bits[i / kBits] >> (i % kBits) & 1) != 0; }

/// Cells gone half way of a step from speed `from` to speed `to`, and in all of it.
int halfWay(int from, int to) { return static_cast<int>(std::lround((3 * from + to) / 4.0)); }
int wholeWay(int from, int to) { return from + to; }

/// Distance from a point to the nearest edge at a time, at most `reach`.
double distanceTo(const mrpt::math::TPoint2D& p, double t, double reach, const ObstacleView& obstacles) {
  double least = reach;
  obstacles.near(p.x, p.y, t, reach, [&](const Proximity& near) { least = std::min(least, near.distance); });
  return least;
}

}  // namespace

WayTiming::Levels WayTiming::levelsOf(const RobotLimits& limits) {
  const double change = std::min(limits.accel, limits.brake) * kStep_s;
  double most = std::ceil(limits.v_max / change - 1e-9);
  if (limits.v_reverse > 0) most = std::max(most, std::ceil(limits.v_max / limits.v_reverse - 1e-9));
  Levels out;
  out.most = static_cast<int>(std::clamp(most, 2.0, static_cast<double>(kLevelsMost)));
  out.step = limits.v_max / out.most;
  out.lowest = limits.v_reverse >= out.step * (1 - 1e-9) ? -1 : 0;
  return out;
}

double WayTiming::spacing(const RobotLimits& limits) { return levelsOf(limits).step * kStep_s / 2; }

bool WayTiming::search(std::span<const mrpt::math::TPoint2D> points, int start, const Query& query) {
  levels_ = levelsOf(query.limits);
  cell_m_ = spacing(query.limits);
  cells_ = static_cast<int>(points.size());
  words_ = (cells_ + kBits - 1) / kBits;
  start_ = start;
  const int steps = static_cast<int>((query.horizon_s - query.delay_s) / kStep_s);
  const int rows = (steps + 1) * (levels_.most - levels_.lowest + 1);
  if (steps < 1 || !standsClear(points[static_cast<size_t>(start)], query)) return false;
  reached_.assign(static_cast<size_t>(rows * words_), 0);
  if (middles_.size() < static_cast<size_t>(steps)) middles_.resize(static_cast<size_t>(steps));
  capSpeeds(points, query);
  const int level = static_cast<int>(std::lround(query.v_start / levels_.step));
  reached(0, std::clamp(level, levels_.lowest, levels_.most))[start / kBits] |= uint64_t{1} << (start % kBits);
  for (int step = 0; step < steps; ++step) {
    const double t = query.delay_s + step * kStep_s;
    markClear(points, query, t + kStep_s / 2, middles_[static_cast<size_t>(step)]);
    markClear(points, query, t + kStep_s, end_);
    if (!spread(step)) return false;
    if (!arrived(step + 1, query.stops)) continue;
    traceBack(step + 1);
    return true;
  }
  return false;
}

bool WayTiming::standsClear(const mrpt::math::TPoint2D& at, const Query& query) const {
  for (double t = 0; t < query.delay_s; t += kStep_s / 2)
    if (distanceTo(at, t, query.reach_m, *query.obstacles) < query.limits.radius_m) return false;
  return true;
}

/// Where a bend, or its beginning, is too sharp for a speed.
void WayTiming::capSpeeds(std::span<const mrpt::math::TPoint2D> points, const Query& query) {
  const int n = levels_.most - levels_.lowest + 1, apart = std::max(2, static_cast<int>(0.4 / cell_m_));
  slow_enough_.assign(static_cast<size_t>(n * words_), 0);
  const auto at = [&](int i) { return points[static_cast<size_t>(std::clamp(i, 0, cells_ - 1))]; };
  const auto heading = [&](int i) {
    const auto a = at(i - apart / 2), b = at(i + apart - apart / 2);
    return std::atan2(b.y - a.y, b.x - a.x);
  };
  const auto bend = [&](int i) {
    return std::remainder(heading(i + apart / 2) - heading(i - apart / 2), 2 * M_PI) / (apart * cell_m_);
  };
  for (int i = 0; i < cells_; ++i) {
    const double change = std::abs(bend(i + apart / 2) - bend(i - apart / 2)) / (apart * cell_m_);
    const double cap = std::min(query.limits.w_max / std::max(std::abs(bend(i)), 1e-6),
                                std::sqrt(query.limits.turn_accel / std::max(change, 1e-6)));
    const int most = std::clamp(static_cast<int>(cap / levels_.step), 1, levels_.most);
    for (int j = levels_.lowest; j <= most; ++j)
      slow_enough_[static_cast<size_t>((j - levels_.lowest) * words_ + i / kBits)] |= uint64_t{1} << (i % kBits);
  }
}

/// The cells in which the robot is clear at a time. What is known of one cell holds for its neighbours as far as the
/// distance goes.
void WayTiming::markClear(std::span<const mrpt::math::TPoint2D> points, const Query& query, double t,
                          std::vector<uint64_t>& out) {
  out.assign(static_cast<size_t>(words_), 0);
  const int farthest = start_ + static_cast<int>((t - query.delay_s) / kStep_s * 2 * levels_.most) + 1;
  const int last = std::min(cells_ - 1, farthest);
  for (int i = 0; i <= last;) {
    const double spare =
        distanceTo(points[static_cast<size_t>(i)], t, query.reach_m, *query.obstacles) - query.keep_out_m;
    const int same = 1 + static_cast<int>(std::abs(spare) / cell_m_);
    for (int k = i; spare >= 0 && k < std::min(i + same, last + 1); ++k) setBit(out, k);
    i += same;
  }
}

bool WayTiming::shifted(const uint64_t* src, int by, const uint64_t* allowed, uint64_t* dst) const {
  uint64_t any = 0;
  const int k = std::abs(by);
  for (int w = 0; w < words_; ++w) {
    uint64_t bits = src[w];
    if (by > 0) bits = bits << k | (w > 0 ? src[w - 1] >> (kBits - k) : 0);
    if (by < 0) bits = bits >> k | (w + 1 < words_ ? src[w + 1] << (kBits - k) : 0);
    bits &= allowed[w];
    dst[w] |= bits;
    any |= bits;
  }
  return any != 0;
}

/// @return whether the robot can be anywhere
bool WayTiming::spread(int step) {
  bool anywhere = false;
  const auto& middle = middles_[static_cast<size_t>(step)];
  for (int from = levels_.lowest; from <= levels_.most; ++from)
    for (int to = std::max(from - 1, levels_.lowest); to <= std::min(from + 1, levels_.most); ++to) {
      half_.assign(static_cast<size_t>(words_), 0);
      if (!shifted(reached(step, from), halfWay(from, to), middle.data(), half_.data())) continue;
      const uint64_t* slow = &slow_enough_[static_cast<size_t>((to - levels_.lowest) * words_)];
      allowed_.assign(slow, slow + words_);
      for (size_t w = 0; w < allowed_.size(); ++w) allowed_[w] &= end_[w];
      const int rest = wholeWay(from, to) - halfWay(from, to);
      anywhere |= shifted(half_.data(), rest, allowed_.data(), reached(step + 1, to));
    }
  return anywhere;
}

bool WayTiming::arrived(int step, bool stops) {
  for (int level = 0; level <= (stops ? 0 : levels_.most); ++level)
    if (bitOf(reached(step, level), cells_ - 1)) {
      last_speed_ = level;
      return true;
    }
  return false;
}

void WayTiming::traceBack(int step) {
  speeds_.assign(static_cast<size_t>(step) + 1, 0);
  int cell = cells_ - 1, level = last_speed_;
  speeds_.back() = level;
  for (int k = step; k > 0; --k)
    for (const int before : {level, level + 1, level - 1}) {  // as even a drive as there is
      const int from = cell - wholeWay(before, level), half = from + halfWay(before, level);
      if (before < levels_.lowest || before > levels_.most || from < 0 || from >= cells_) continue;
      if (half < 0 || half >= cells_) continue;
      if (!bitOf(reached(k - 1, before), from) || !bitOf(middles_[static_cast<size_t>(k - 1)].data(), half)) continue;
      cell = from;
      level = before;
      speeds_[static_cast<size_t>(k - 1)] = level;
      break;
    }
}

double WayTiming::wayAt(double t) const {
  double way = 0;
  const double last = duration();
  t = std::clamp(t, 0.0, last);
  for (size_t k = 0; k + 1 < speeds_.size(); ++k) {
    const double share = std::clamp(t / kStep_s - static_cast<double>(k), 0.0, 1.0);
    way += (speeds_[k] * share + (speeds_[k + 1] - speeds_[k]) * share * share / 2) * 2 * cell_m_;
    if (share < 1) break;
  }
  return way;
}

}  // namespace sidestep
