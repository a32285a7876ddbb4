// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <cmath>

namespace sidestep {

/// Kinematics of a differential drive, (2.1)-(2.4): lengths in m, angles in rad, counter-clockwise.

/// sin(x) / x, exactly near 0.
inline double sinc(double x) { return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x; }

/// `pose` after an arc of length `distance_m` and turn `turn_rad`, exactly; heading in [-pi, pi).
mrpt::math::TPose2D alongArc(const mrpt::math::TPose2D& pose, double distance_m, double turn_rad);

/// An arc from the origin along x, exactly (2.4); heading not wrapped.
inline mrpt::math::TPose2D arcFromOrigin(double distance_m, double turn_rad) {
  const double half = 0.5 * turn_rad, chord = distance_m * sinc(half);
  return {chord * std::cos(half), chord * std::sin(half), turn_rad};
}

/// `pose` after a short arc, the chord taken to be as long as the arc (2.1), (3.7); heading not wrapped.
inline mrpt::math::TPose2D alongChord(const mrpt::math::TPose2D& pose, double distance_m, double turn_rad) {
  const double mean = pose.phi + 0.5 * turn_rad;
  return {pose.x + distance_m * std::cos(mean), pose.y + distance_m * std::sin(mean), pose.phi + turn_rad};
}

/// Motion of the base: distances and turns, or speeds and turn rates.
struct BodyMotion {
  double ahead = 0, turn = 0;
};
/// The same at the rims of the wheels.
struct WheelMotion {
  double left = 0, right = 0;
};
/// (2.2) solved for the wheels.
inline WheelMotion wheelsOf(const BodyMotion& body, double track_m) {
  const double half = 0.5 * track_m;
  return {body.ahead - half * body.turn, body.ahead + half * body.turn};
}
/// (2.2).
inline BodyMotion bodyOf(const WheelMotion& wheels, double track_m) {
  return {0.5 * (wheels.left + wheels.right), (wheels.right - wheels.left) / track_m};
}
/// Rim speed of the faster wheel, (2.37) and (2.38) [m/s].
inline double outerWheelSpeed(double v, double w, double track_m) { return std::abs(v) + 0.5 * track_m * std::abs(w); }

}  // namespace sidestep
