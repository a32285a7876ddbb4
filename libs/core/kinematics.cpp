// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/kinematics.h"

#include <mrpt/math/wrap2pi.h>

namespace sidestep {

mrpt::math::TPose2D alongArc(const mrpt::math::TPose2D& pose, double distance_m, double turn_rad) {
  // The chord of an arc is sin(half the turn) / (half the turn) as long and points along half the turn.
  const double half = 0.5 * turn_rad, chord = distance_m * sinc(half);
  return {pose.x + chord * std::cos(pose.phi + half), pose.y + chord * std::sin(pose.phi + half),
          mrpt::math::wrapToPi(pose.phi + turn_rad)};
}

}  // namespace sidestep
