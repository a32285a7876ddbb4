// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "core/obstacles.h"

namespace sidestep {

inline double dot(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.y - a.y * b.x; }
inline mrpt::math::TPoint2D pointOf(const mrpt::math::TPose2D& pose) { return {pose.x, pose.y}; }

/// An angle brought into (-pi, pi].
inline double wrapped(double angle) { return angle - 2 * M_PI * std::ceil((angle - M_PI) / (2 * M_PI)); }

/// The point of a segment that is nearest to `p`.
inline mrpt::math::TPoint2D nearestPoint(const Segment& segment, const mrpt::math::TPoint2D& p) {
  const auto ab = segment.b - segment.a;
  const double length2 = dot(ab, ab);
  return length2 > 0 ? segment.a + ab * std::clamp(dot(p - segment.a, ab) / length2, 0.0, 1.0) : segment.a;
}

/// Index of the pose that is nearest to `p`, the first of several; 0 for an empty path.
inline size_t nearestPose(std::span<const mrpt::math::TPose2D> path, const mrpt::math::TPoint2D& p) {
  size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < path.size(); ++i) {
    const double d = std::hypot(path[i].x - p.x, path[i].y - p.y);
    if (d >= least) continue;
    least = d;
    nearest = i;
  }
  return nearest;
}

/// Whether two segments have a point in common; parallel ones have none.
inline bool intersect(const Segment& s, const Segment& t) {
  const auto d = t.b - t.a, e = s.b - s.a, f = s.a - t.a;
  const double det = cross(d, e);
  if (det == 0) return false;
  const double along = cross(f, e) / det, across = cross(f, d) / det;
  return along >= 0 && along <= 1 && across >= 0 && across <= 1;
}

}  // namespace sidestep
