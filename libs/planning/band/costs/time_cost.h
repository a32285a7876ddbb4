// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/band/interval.h"

namespace sidestep {

/// Transition time (2.32): r = dt. Squares of equal intervals are least, so this also keeps intervals alike.
struct TimeCost {
  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    add(i.dt, MotionGradient{0, 0, 0, 1});
  }
};

}  // namespace sidestep
