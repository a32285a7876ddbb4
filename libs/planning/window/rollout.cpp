// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/rollout.h"

#include <cmath>

namespace sidestep {

ArcPose onArc(double v, double w, double t) {
  const double half = 0.5 * w * t, chord = std::abs(half) > 1e-9 ? v * t * std::sin(half) / half : v * t;
  return {chord * std::cos(half), chord * std::sin(half), 2 * half};
}

}  // namespace sidestep
