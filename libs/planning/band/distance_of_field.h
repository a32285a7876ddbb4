// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sidestep {

class DistanceField;

/// Distance to the nearest obstacle of the map [m].
double distanceOfField(const DistanceField& field, double x, double y);

}  // namespace sidestep
