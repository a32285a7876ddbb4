// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/band/interval.h"

namespace sidestep {

/// Preference for driving forwards: r = speed backwards [m/s]; 0 forwards.
struct ForwardCost {
  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    if (i.v < 0) add(-i.v, MotionGradient{-1, 0, 0, 0});
  }
};

}  // namespace sidestep
