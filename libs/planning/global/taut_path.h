// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include <vector>

#include "maps/distance_field.h"

namespace sidestep {

/// Pulls a path tight, as a string around the obstacles: each step shortens it and keeps all its pieces at the
/// clearance
/// (`DistanceField::visible`), and it stays on its side of each obstacle bigger than what can be seen across. First it
/// goes from each point straight to the last one in sight, then each corner is cut as deep as sight allows, until a
/// round gains less than a thousandth of a cell.
/// @param path  map frame [m], each piece visible; the ends stay
void pullTaut(const DistanceField& field, double clearance_m, std::vector<mrpt::math::TPoint2D>& path);

}  // namespace sidestep
