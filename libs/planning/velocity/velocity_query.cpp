// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/velocity_query.h"

#include <algorithm>
#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

/// Gaps between forbidden intervals that are narrower than this are no way through [m/s].
constexpr double kNarrow = 1e-9;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moves `t` up out of all intervals.
template <class Intervals>
double freeAbove(const Intervals& covered, double t) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const auto& i : covered)
      if (i.low <= t + kNarrow && t < i.high) {
        t = i.high;
        moved = true;
      }
  }
  return t;
}

template <class Intervals>
double freeBelow(const Intervals& covered, double t) {
  for (bool moved = true; moved;) {
    moved = false;
    for (const auto& i : covered)
      if (i.low < t && t <= i.high + kNarrow) {
        t = i.low;
        moved = true;
      }
  }
  return t;
}

}  // namespace

void VelocityQuery::clear() {
  for (int k = 0; k < 3; ++k) {
    nx_[k].clear();
    ny_[k].clear();
    c_[k].clear();
  }
  edges_.clear();
}

void VelocityQuery::add(const VelocityRegion& region) {
  const int index = static_cast<int>(size());
  for (size_t k = 0; k < 3; ++k) {
    nx_[k].push_back(region.sides[k].nx);
    ny_[k].push_back(region.sides[k].ny);
    c_[k].push_back(region.sides[k].c);
  }
  for (int e = 0; e < region.edge_count; ++e) edges_.push_back({region.edges[static_cast<size_t>(e)], index});
}

int VelocityQuery::coveredBy(const TPoint2D& v) const {
  const size_t n = size();
  for (size_t i = 0; i < n; ++i)
    if (nx_[0][i] * v.x + ny_[0][i] * v.y > c_[0][i] && nx_[1][i] * v.x + ny_[1][i] * v.y > c_[1][i] &&
        nx_[2][i] * v.x + ny_[2][i] * v.y > c_[2][i])
      return static_cast<int>(i);
  return -1;
}

/// The queue of edges, the one whose line comes nearest to `preferred` first.
void VelocityQuery::rank(const TPoint2D& preferred) {
  queue_.clear();
  for (size_t e = 0; e < edges_.size(); ++e) {
    const auto& line = edges_[e].line;
    const TPoint2D away = preferred - line.from;
    const double t = std::clamp(dot(away, line.along), line.low, line.high);
    const TPoint2D rest = away - line.along * t;
    queue_.push_back({dot(rest, rest), static_cast<int>(e)});
  }
  std::make_heap(queue_.begin(), queue_.end());
}

/// Which parts of the edge between low and high lie inside other regions; false if one region has all of it.
bool VelocityQuery::cover(const Edge& edge, double low, double high) {
  covered_.clear();
  const double ox = edge.line.from.x, oy = edge.line.from.y, ux = edge.line.along.x, uy = edge.line.along.y;
  const size_t n = size();
  for (size_t i = 0; i < n; ++i) {
    if (static_cast<int>(i) == edge.region) continue;
    double from = -kInfinity, to = kInfinity;
    for (int k = 0; k < 3; ++k) {
      const double rise = nx_[k][i] * ux + ny_[k][i] * uy, lack = c_[k][i] - (nx_[k][i] * ox + ny_[k][i] * oy);
      if (rise > 0)
        from = std::max(from, lack / rise);
      else if (rise < 0)
        to = std::min(to, lack / rise);
      else if (lack >= 0)
        to = -kInfinity;
      if (!(to - from > kNarrow) || to <= low || from >= high) break;
    }
    if (!(to - from > kNarrow) || to <= low || from >= high) continue;
    if (from < low && to > high) return false;
    covered_.push_back({from, to});
  }
  return true;
}

bool VelocityQuery::nearestOn(const Edge& edge, const TPoint2D& preferred, double v_max, double best2,
                              VelocityCandidate& out) {
  const auto& line = edge.line;
  const double along = dot(line.from, line.along);
  const double inside2 = v_max * v_max - (dot(line.from, line.from) - along * along);
  if (!(inside2 >= 0)) return false;
  const double half = std::sqrt(inside2), nearest = dot(preferred - line.from, line.along);
  double low = std::max(line.low, -along - half), high = std::min(line.high, -along + half);
  if (low > high) return false;
  const TPoint2D rest = preferred - (line.from + line.along * nearest);
  const double rest2 = dot(rest, rest);
  const double start = std::clamp(nearest, low, high);
  if (best2 < kInfinity) {  // only what is nearer than the best so far is of interest
    if (rest2 >= best2) return false;
    const double reach = std::sqrt(best2 - rest2);
    low = std::max(low, nearest - reach);
    high = std::min(high, nearest + reach);
    if (low > high) return false;
  }
  if (!cover(edge, low, high)) return false;
  const double above = freeAbove(covered_, start), below = freeBelow(covered_, start);
  const double up = above <= high ? std::abs(above - nearest) : kInfinity;
  const double down = below >= low ? std::abs(below - nearest) : kInfinity;
  const double off = std::min(up, down);
  if (off == kInfinity) return false;
  out.velocity = line.from + line.along * (up <= down ? above : below);
  out.distance = std::sqrt(rest2 + off * off);
  out.region = edge.region;
  return true;
}

bool VelocityQuery::nearest(const TPoint2D& preferred, double v_max, VelocityCandidate& best) {
  const double speed = preferred.norm();
  const TPoint2D start = speed > v_max ? preferred * (v_max / speed) : preferred;
  if (coveredBy(start) < 0) {
    best = {start, std::max(0.0, speed - v_max), -1};
    return true;
  }
  rank(preferred);
  double best2 = kInfinity;
  VelocityCandidate candidate;
  while (!queue_.empty() && queue_.front().bound2 < best2) {
    const auto& edge = edges_[static_cast<size_t>(queue_.front().edge)];
    std::pop_heap(queue_.begin(), queue_.end());
    queue_.pop_back();
    if (!nearestOn(edge, preferred, v_max, best2, candidate)) continue;
    if (candidate.distance * candidate.distance >= best2) continue;
    best2 = candidate.distance * candidate.distance;
    best = candidate;
  }
  return best2 < kInfinity;
}

void VelocityQuery::candidates(const TPoint2D& preferred, double v_max, std::vector<VelocityCandidate>& out) {
  out.clear();
  VelocityCandidate candidate;
  for (const auto& edge : edges_)
    if (nearestOn(edge, preferred, v_max, kInfinity, candidate)) out.push_back(candidate);
}

}  // namespace sidestep
