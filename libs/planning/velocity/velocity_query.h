// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "planning/velocity/velocity_region.h"

namespace sidestep {

/// A velocity that came into question, and the region that hides it (-1: none, it is free).
struct VelocityCandidate {
  mrpt::math::TPoint2D velocity;
  double distance = 0;  ///< to the preferred velocity [m/s]
  int region = -1;      ///< on whose edge it lies; -1: the preferred velocity itself
};

/// The velocity nearest to a preferred one, outside all regions and not faster than a limit: (2.29), exactly.
///
/// The nearest free velocity is the preferred one, or lies on an edge: where the edge is nearest, where it meets
/// another one, or where it meets the circle of the largest speed. So each edge, clipped to the circle, loses the
/// intervals that other regions cover, and the free point nearest to the preferred velocity is found on what is left.
/// Edges are taken in the order of their distance and the search ends when the next one cannot win. Cost: O(edges
/// looked at x regions), most often few; O(n^2) at worst.
class VelocityQuery {
 public:
  void clear();
  void add(const VelocityRegion& region);
  size_t size() const { return nx_[0].size(); }
  /// @return false if every velocity within `v_max` is forbidden; `best` is then left alone
  bool nearest(const mrpt::math::TPoint2D& preferred, double v_max, VelocityCandidate& best);
  /// The best point of each edge of the last `nearest`, without the short cuts, for explanations.
  void candidates(const mrpt::math::TPoint2D& preferred, double v_max, std::vector<VelocityCandidate>& out);
  /// The first region that forbids `v`, or -1.
  int coveredBy(const mrpt::math::TPoint2D& v) const;

 private:
  struct Edge {
    VelocityRegion::Edge line;
    int region;
  };
  struct Ranked {
    double bound2;
    int edge;
    bool operator<(const Ranked& o) const { return bound2 > o.bound2 || (bound2 == o.bound2 && edge > o.edge); }
  };
  struct Interval {
    double low, high;
  };
  void rank(const mrpt::math::TPoint2D& preferred);
  bool nearestOn(const Edge& edge, const mrpt::math::TPoint2D& preferred, double v_max, double best2,
                 VelocityCandidate& out);
  bool cover(const Edge& edge, double low, double high);

  std::vector<double> nx_[3], ny_[3], c_[3];  ///< of the regions' sides, side by side for speed
  std::vector<Edge> edges_;
  std::vector<Ranked> queue_;
  std::vector<Interval> covered_;
};

}  // namespace sidestep
