// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <span>

namespace sidestep {

/// Above it the dissertation counts a collision (4.11).
constexpr double kCollisionIndexThreshold = 0.54;

/// Collision index (4.11): how near the robot is to the nearest of the obstacles, 1 on top of it, towards 0 far away,
///
///   CI = max_i exp(-((x_r - x_i) / (sqrt(2) sigma))^2 - ((y_r - y_i) / (sqrt(2) sigma))^2).
///
/// With sigma = 0.45 m the threshold 0.54 is a distance of centres of 0.4996 m.
///
/// @param sigma_m  of the space around an obstacle [m], > 0
/// @return 0 without obstacles
double collisionIndex(const mrpt::math::TPoint2D& robot, std::span<const mrpt::math::TPoint2D> obstacles,
                      double sigma_m = 0.45);

/// delta_min(t) of (4.6): 1 at contact, towards 0 far away.
/// @param clearance_m  between the rims; overlap counts as contact, infinity gives 0
double deltaMin(double clearance_m);

}  // namespace sidestep
