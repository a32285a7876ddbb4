// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <array>
#include <limits>

#include "core/obstacles.h"

namespace sidestep {

/// A convex, open set of forbidden velocities of the robot's centre [m/s, map axes]: a cone, a cone whose tip is cut
/// off, or a half-plane. A velocity on an edge is allowed: the robot grazes.
struct VelocityRegion {
  /// nx vx + ny vy > c inside.
  struct Side {
    double nx = 0, ny = 0, c = 0;
  };
  /// from + t along, low <= t <= high; `along` is a unit vector.
  struct Edge {
    mrpt::math::TPoint2D from, along;
    double low = 0, high = std::numeric_limits<double>::infinity();
  };
  std::array<Side, 3> sides;  ///< inside is inside all three; one that is not needed repeats another
  std::array<Edge, 3> edges;
  int edge_count = 0;

  bool contains(const mrpt::math::TPoint2D& v) const {
    for (const auto& s : sides)
      if (!(s.nx * v.x + s.ny * v.y > s.c)) return false;
    return true;
  }
};

/// A disc that moves, as the robot sees it.
struct DiscView {
  mrpt::math::TPoint2D offset;    ///< from the robot's centre to the disc's [m, map axes]
  mrpt::math::TPoint2D velocity;  ///< [m/s, map axes]
  double radius_sum = 0.6;        ///< of both discs, with all margins [m]
  double velocity_sd = 0;         ///< doubt about `velocity`: both legs move outwards by it [m/s]
  double share = 0.5;             ///< of the avoiding that is the robot's: 0.5 both do, 1 the disc is blind
};

/// Velocity obstacle (Fiorini 1998), reciprocal (van den Berg 2008) and hybrid reciprocal (Snape 2011), figure 2.4.
enum class RegionKind { kVo, kRvo, kHrvo };

/// The velocities that meet the disc within `horizon_s` if it keeps its velocity.
///
/// VO: cone of the directions to the disc of radius `radius_sum`, apex at the disc's velocity v_o. RVO: apex at
/// (1 - share) v_r + share v_o. HRVO: on the side on which the robot already passes, the leg of the RVO, on the other
/// that of the VO, so that two robots agree on sides. Head-on the robot takes itself to pass with the disc on its left;
/// `keep_right` widens that preference. The cut at gap / horizon is straight, tangent to the exact (round) one, hence
/// on the safe side. Overlapping discs give a half-plane: separate, at `share` of the speed that ends the overlap in
/// `separate_s`.
///
/// @param own         the robot's velocity [m/s]
/// @param horizon_s   > 0; infinity: no cut, as in (2.28)
/// @param keep_right  how much the robot must already move to the disc's left side to stay there [m/s], >= 0
VelocityRegion discRegion(RegionKind kind, const DiscView& disc, const mrpt::math::TPoint2D& own, double horizon_s,
                          double separate_s, double keep_right = 0);

/// The velocities that bring a disc of radius `radius_m` into the wall within `horizon_s`; `wall` is relative to its
/// centre.
VelocityRegion wallRegion(const Segment& wall, double radius_m, double horizon_s, double separate_s);

/// The velocities that could end in the disc within `period_s` however the other one moves by the same rule (each stays
/// on its side of the middle between them, as in buffered Voronoi cells, Zhou 2017); against a blind disc (share 1),
/// those that do if it goes on. Standing still is never forbidden by the first kind, so that no set of them excludes
/// all.
VelocityRegion shieldRegion(const DiscView& disc, double period_s);

}  // namespace sidestep
