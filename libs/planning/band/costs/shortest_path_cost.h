// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/band/interval.h"

namespace sidestep {

/// Short paths: r = way travelled in an interval [m] (forwards positive), v dt.
struct ShortestPathCost {
  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    add(i.v * i.dt, MotionGradient{i.dt, 0, 0, i.v});
  }
};

}  // namespace sidestep
