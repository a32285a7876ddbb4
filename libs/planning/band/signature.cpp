// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/signature.h"

#include <algorithm>

namespace sidestep {
namespace {

/// The factor of an entry: splitmix64.
uint64_t factorOf(uint64_t index) {
  uint64_t z = (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return (z ^ (z >> 31)) | 1;
}

/// Crossing of the ray from the origin towards -v by the way from (u0, v0) to (u1, v1), with the sense of u.
int crossing(double u0, double v0, double u1, double v1) {
  if ((u0 <= 0) == (u1 <= 0)) return 0;
  const double v = v0 + (v1 - v0) * (u0 / (u0 - u1));
  return v >= 0 ? 0 : u1 > u0 ? 1 : -1;
}

}  // namespace

int SignatureReader::crossings(double u, double v) const {
  // beside the whole band only the ends matter
  if (v <= v_low_) return 0;
  if (v >= v_high_) return (points_.back().u > u ? 1 : 0) - (points_.front().u > u ? 1 : 0);
  int n = 0;
  for (size_t k = 0; k + 1 < points_.size(); ++k)
    n += crossing(points_[k].u - u, points_[k].v - v, points_[k + 1].u - u, points_[k + 1].v - v);
  return n;
}

int SignatureReader::crossingsMoving(const ObstacleView& obstacles, const GoalFrame& frame, size_t index,
                                     double horizon_s) const {
  int n = 0;
  double u0 = 0, v0 = 0;
  const auto step = [&](const Point& p, double t, bool first) {
    const MovingItem& o = obstacles.movingIn(t)[index];
    const double x = o.x + o.vx * (t - o.middle), y = o.y + o.vy * (t - o.middle);
    const double u = p.u - frame.u(x, y), v = p.v - frame.v(x, y);
    if (!first) n += crossing(u0, v0, u, v);
    u0 = u;
    v0 = v;
  };
  for (const auto& p : points_) step(p, p.t, &p == &points_.front());
  for (double t = points_.back().t; t < horizon_s;) {
    t = std::min(t + ObstacleView::kSlice_s, horizon_s);
    step(points_.back(), t, false);
  }
  return n;
}

uint64_t SignatureReader::read(const Band& band, const GoalFrame& frame, const ObstacleView& obstacles,
                               double horizon_s, std::span<const mrpt::math::TPoint2D> islands) {
  points_.clear();
  for (const auto& p : band) points_.push_back({frame.u(p.x, p.y), frame.v(p.x, p.y), p.t});
  v_low_ = v_high_ = points_.front().v;
  for (const auto& p : points_) {
    v_low_ = std::min(v_low_, p.v);
    v_high_ = std::max(v_high_, p.v);
  }
  uint64_t sum = 0, index = 0;
  const auto enter = [&sum, &index](int n) {
    if (n != 0) sum += factorOf(index) * static_cast<uint64_t>(static_cast<int64_t>(n));
    ++index;
  };
  for (const auto& o : obstacles.still()) {
    const double x = o.x + o.ex / 2, y = o.y + o.ey / 2;
    enter(crossings(frame.u(x, y), frame.v(x, y)));
  }
  for (const auto& p : islands) enter(crossings(frame.u(p.x, p.y), frame.v(p.x, p.y)));
  const size_t movers = obstacles.movingIn(0).size();
  for (size_t i = 0; i < movers; ++i) enter(crossingsMoving(obstacles, frame, i, horizon_s));
  return sum;
}

}  // namespace sidestep
