// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "maps/distance_field.h"

namespace sidestep {

/// The way to the nearest place with enough clearance that can be reached from a position: never through a wall,
/// however thin. Shortest over free cells (Dijkstra, eight moves), so that "near" is what a robot would drive.
///
/// A position that lies in an obstacle is moved out of it first, to the nearest free cell as the crow flies.
/// @param clearance_m      wanted at the end [m]
/// @param max_distance_m   longest way [m]
/// @return points from the position to the place: the position alone if it has the clearance, none if no place has it
std::vector<mrpt::math::TPoint2D> wayToClearance(const DistanceField& field, const mrpt::math::TPoint2D& from,
                                                 double clearance_m, double max_distance_m);

}  // namespace sidestep
