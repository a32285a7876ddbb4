// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

namespace sidestep {

/// A pose of the band and when it is reached: s_k and the sum of the intervals before it (2.31).
///
/// Keeping times instead of intervals changes nothing of (2.31)-(2.34), but what depends on where an obstacle is *then*
/// sees one pose only, so that the normal equations stay banded with the exact derivative by time.
struct BandPose {
  double x = 0, y = 0;  ///< map frame [m]
  double theta = 0;     ///< [rad], continuous along the band: not wrapped
  double t = 0;         ///< from now [s]
};

/// The motion from one pose of the band to the next, taken as an arc: chord direction at the mean heading.
struct Interval {
  double dt = 0;     ///< [s]
  double c = 1;      ///< cosine of the mean heading
  double s = 0;      ///< its sine
  double ahead = 0;  ///< displacement along the mean heading [m]
  double aside = 0;  ///< displacement across it [m]: 0 on an arc, h_k of (2.33)
  double turn = 0;   ///< [rad]
  double arc = 1;    ///< arc by chord length, 1 + turn^2 / 24
  double rate = 0;   ///< 1 / dt
  double v = 0;      ///< mean speed, forwards positive, (2.35) [m/s]
  double w = 0;      ///< mean turn rate (2.36) [rad/s]
};

inline Interval intervalBetween(const BandPose& a, const BandPose& b) {
  Interval i;
  const double mean = 0.5 * (a.theta + b.theta), dx = b.x - a.x, dy = b.y - a.y;
  i.dt = b.t - a.t;
  i.c = std::cos(mean);
  i.s = std::sin(mean);
  i.ahead = i.c * dx + i.s * dy;
  i.aside = i.c * dy - i.s * dx;
  i.turn = b.theta - a.theta;
  i.arc = 1 + i.turn * i.turn / 24;
  i.rate = 1 / i.dt;
  i.v = i.ahead * i.arc * i.rate;
  i.w = i.turn * i.rate;
  return i;
}

/// Derivatives of a residual by what an interval shows.
struct MotionGradient {
  double v = 0, w = 0, aside = 0, dt = 0;
};

/// Derivatives of a residual by a pose of the band.
struct PoseGradient {
  double x = 0, y = 0, theta = 0, t = 0;
};

/// Chain rule: derivatives by the two poses of an interval, from those by its motion.
inline void byPoses(const Interval& i, const MotionGradient& g, PoseGradient& a, PoseGradient& b) {
  const double by_ahead = g.v * i.arc * i.rate, bend = g.v * i.ahead * i.turn * i.rate / 12;
  const double both = 0.5 * (by_ahead * i.aside - g.aside * i.ahead), spin = bend + g.w * i.rate;
  b.x = by_ahead * i.c - g.aside * i.s;
  b.y = by_ahead * i.s + g.aside * i.c;
  b.theta = both + spin;
  b.t = g.dt - (g.v * i.v + g.w * i.w) * i.rate;
  a.x = -b.x;
  a.y = -b.y;
  a.theta = both - spin;
  a.t = -b.t;
}

}  // namespace sidestep
