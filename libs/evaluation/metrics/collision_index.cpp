// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/collision_index.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

double collisionIndex(const mrpt::math::TPoint2D& robot, std::span<const mrpt::math::TPoint2D> obstacles,
                      double sigma_m) {
  double largest = 0;
  for (const auto& o : obstacles) {
    const double dx = robot.x - o.x, dy = robot.y - o.y;
    largest = std::max(largest, std::exp(-(dx * dx + dy * dy) / (2 * sigma_m * sigma_m)));
  }
  return largest;
}

double deltaMin(double clearance_m) {
  const double d = std::max(0.0, clearance_m);
  return std::exp(-d * d / 3);
}

}  // namespace sidestep
