// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPoint2D.h>

#include "planning/band/interval.h"

namespace sidestep {

/// Attraction of a pose by a point of the global path: r = the two components of their offset [m].
struct ViaPointCost {
  template <class Add>
  void evaluate(const BandPose& pose, const mrpt::math::TPoint2D& via, Add&& add) const {
    add(pose.x - via.x, PoseGradient{1, 0, 0, 0});
    add(pose.y - via.y, PoseGradient{0, 1, 0, 0});
  }
};

}  // namespace sidestep
