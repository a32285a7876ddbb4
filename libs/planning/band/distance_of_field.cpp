// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/distance_of_field.h"

namespace sidestep {

double distanceOfField(const DistanceField&, double, double) { return 1e9; }

}  // namespace sidestep
