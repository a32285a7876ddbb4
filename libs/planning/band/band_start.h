// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <span>

#include "planning/band/band.h"
#include "planning/band/way_timing.h"

namespace sidestep {

/// A first band along a way: equal times, headings along the way, a turn on the spot where the start or a wanted goal
/// heading is far off.
struct BandStart {
  mrpt::math::TPose2D start, goal;
  BandEnds ends;
  bool goal_heading_free = true;
  double interval_s = 0.3;
  int poses_max = 150;
};
class BandMaker {
 public:
  /// As fast as the limits allow, whatever is in the way.
  void along(std::span<const mrpt::math::TPoint2D> way, const BandStart& spec, const RobotLimits& limits, Band& out);
  /// In the first time in which the way is clear: with waits, and backing off behind the start. @return whether there
  /// is one
  bool alongWhenClear(std::span<const mrpt::math::TPoint2D> way, const BandStart& spec, WayTiming::Query query,
                      Band& out);

 private:
  void smooth(std::span<const mrpt::math::TPoint2D> way);
  void begin(const BandStart& spec, const RobotLimits& limits, Band& out) const;
  /// Poses at equal times of a profile, `duration()` long, that says the way done: `wayAt(t)`.
  template <class Profile>
  void follow(const Profile& profile, const BandStart& spec, const RobotLimits& limits, Band& out) const;
  mrpt::math::TPoint2D pointAt(double s) const;
  double headingAt(double s, double near) const;

  std::vector<mrpt::math::TPoint2D> points_, dense_;
  std::vector<double> length_;  ///< along the way up to each point
  std::vector<mrpt::math::TPoint2D> cells_;
  WayTiming timing_;
};

/// Angle that differs from `angle` by whole turns and lies within half a turn of `near`.
double nearestAngle(double angle, double near);

}  // namespace sidestep
