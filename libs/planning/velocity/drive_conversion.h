// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>
#include <mrpt/math/TTwist2D.h>

namespace sidestep {

/// The (v, w) of a differential drive that follows a velocity of its centre best (Alonso-Mora 2010).
///
///   w = phi / T,   v = |u| phi sin(phi) / (2 (1 - cos(phi)))        phi: from the heading to u; v = |u| for phi = 0
///
/// After T the heading is that of u, and the arc's end is as near to u T as an arc of that w gets. Beyond 90 deg v
/// falls to 0 at 180 deg: the robot turns on the spot. w and v are clamped to the limits.
///
/// @param velocity  [m/s, map axes]
/// @param heading   of the robot [rad, map frame]
/// @param align_s   T, the time to turn into the velocity's direction [s], > 0
mrpt::math::TTwist2D driveFor(const mrpt::math::TPoint2D& velocity, double heading, double align_s, double v_max,
                              double w_max);

}  // namespace sidestep
