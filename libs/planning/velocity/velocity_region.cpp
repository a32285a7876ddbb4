// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/velocity_region.h"

#include <algorithm>
#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

TPoint2D turned(const TPoint2D& a, double c, double s) { return {c * a.x - s * a.y, s * a.x + c * a.y}; }

/// All velocities with n . v > c.
VelocityRegion halfPlane(const TPoint2D& n, double c) {
  VelocityRegion r;
  r.sides.fill({n.x, n.y, c});
  r.edges[0] = {{n.x * c, n.y * c}, {-n.y, n.x}, -std::numeric_limits<double>::infinity()};
  r.edge_count = 1;
  return r;
}

/// The cone between two legs, without the part within `cut` of the apex along `axis`.
VelocityRegion cutCone(const TPoint2D& apex, const TPoint2D& left, const TPoint2D& right, const TPoint2D& axis,
                       double cut) {
  VelocityRegion r;
  r.sides[0] = {left.y, -left.x, cross(apex, left)};
  r.sides[1] = {-right.y, right.x, cross(right, apex)};
  r.sides[2] = r.sides[0];
  r.edges[0] = {apex, left};
  r.edges[1] = {apex, right};
  r.edge_count = 2;
  if (!(cut > 0)) return r;
  r.sides[2] = {axis.x, axis.y, dot(axis, apex) + cut};
  r.edges[0].from = apex + left * (cut / dot(left, axis));
  r.edges[1].from = apex + right * (cut / dot(right, axis));
  const TPoint2D front = r.edges[1].from - r.edges[0].from;
  const double length = front.norm();
  r.edges[2] = {r.edges[0].from, front * (1 / length), 0, length};
  r.edge_count = length > 0 ? 3 : 2;
  return r;
}

/// The direction of a vector of length `d`; any direction will do for none.
TPoint2D unit(const TPoint2D& a, double d) { return d > 0 ? a * (1 / d) : TPoint2D(1, 0); }

}  // namespace

VelocityRegion discRegion(RegionKind kind, const DiscView& disc, const TPoint2D& own, double horizon_s,
                          double separate_s, double keep_right) {
  const double d = disc.offset.norm(), R = disc.radius_sum, share = kind == RegionKind::kVo ? 1 : disc.share;
  const TPoint2D axis = unit(disc.offset, d), relative = own - disc.velocity;
  if (d <= R) {
    const double along = (1 - share) * dot(axis, own) + share * dot(axis, disc.velocity);
    return halfPlane(axis, along - share * (R - d) / separate_s - disc.velocity_sd);
  }
  const double s = R / d, c = std::sqrt((1 - s) * (1 + s));
  const TPoint2D left = turned(axis, c, s), right = turned(axis, c, -s);
  TPoint2D apex = disc.velocity;
  if (kind == RegionKind::kRvo) apex += relative * (1 - share);
  if (kind == RegionKind::kHrvo) {
    // The apex lies on the VO's leg of one side and on the RVO's of the other: cross(right, left) = sin(2 alpha).
    const double scale = (1 - share) / (2 * s * c);
    const bool passes_left = cross(axis, relative) > keep_right;
    apex += passes_left ? right * (scale * cross(relative, left)) : left * (-scale * cross(relative, right));
  }
  const double doubt = disc.velocity_sd;
  if (doubt > 0) apex -= axis * (doubt / s);
  return cutCone(apex, left, right, axis, std::max(0.0, (d - R) / horizon_s + doubt / s - doubt));
}

VelocityRegion wallRegion(const Segment& wall, double radius_m, double horizon_s, double separate_s) {
  const TPoint2D nearest = nearestPoint(wall, {0, 0});
  const double d = nearest.norm();
  const TPoint2D axis = unit(nearest, d);
  if (d <= radius_m) return halfPlane(axis, -(radius_m - d) / separate_s);
  const auto leg = [&](const TPoint2D& end, double side) {
    const double de = end.norm(), s = std::min(1.0, radius_m / de);
    return turned(end * (1 / de), std::sqrt((1 - s) * (1 + s)), side * s);
  };
  const TPoint2D left_a = leg(wall.a, 1), left_b = leg(wall.b, 1), right_a = leg(wall.a, -1), right_b = leg(wall.b, -1);
  return cutCone({0, 0}, cross(left_a, left_b) > 0 ? left_b : left_a, cross(right_a, right_b) < 0 ? right_b : right_a,
                 axis, (d - radius_m) / horizon_s);
}

VelocityRegion shieldRegion(const DiscView& disc, double period_s) {
  constexpr double kRounding_m = 1e-7;
  const double d = disc.offset.norm(), gap = d - disc.radius_sum - kRounding_m;
  const TPoint2D axis = unit(disc.offset, d);
  const double blind = disc.share >= 1 ? dot(axis, disc.velocity) : 0;
  return halfPlane(axis, blind + (disc.share >= 1 ? 1 : 0.5) * gap / period_s);
}

}  // namespace sidestep
