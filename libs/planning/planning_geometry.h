// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TPose2D.h>

#include <algorithm>
#include <cmath>

#include "core/obstacles.h"

namespace sidestep {

inline double dot(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const mrpt::math::TPoint2D& a, const mrpt::math::TPoint2D& b) { return a.x * b.y - a.y * b.x; }

/// An angle brought into (-pi, pi].
inline double wrapped(double angle) { return angle - 2 * M_PI * std::ceil((angle - M_PI) / (2 * M_PI)); }

/// The point of a wall that is nearest to `p`.
inline mrpt::math::TPoint2D nearestOn(const Segment& wall, const mrpt::math::TPoint2D& p) {
  const auto ab = wall.b - wall.a;
  const double length2 = dot(ab, ab);
  return length2 > 0 ? wall.a + ab * std::clamp(dot(p - wall.a, ab) / length2, 0.0, 1.0) : wall.a;
}

}  // namespace sidestep
