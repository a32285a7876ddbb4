// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/drive_conversion.h"

#include "core/geometry.h"

namespace sidestep {

mrpt::math::TTwist2D driveFor(const mrpt::math::TPoint2D& velocity, double heading, double align_s, double v_max,
                              double w_max) {
  const double speed = velocity.norm();
  if (!(speed > 0)) return {0, 0, 0};
  const double phi = wrapped(std::atan2(velocity.y, velocity.x) - heading);
  const double share = std::abs(phi) < 1e-4 ? 1 : phi * std::sin(phi) / (2 * (1 - std::cos(phi)));
  return {std::clamp(speed * share, 0.0, v_max), 0, std::clamp(phi / align_s, -w_max, w_max)};
}

}  // namespace sidestep
