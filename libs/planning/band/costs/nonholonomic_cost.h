// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/band/interval.h"

namespace sidestep {

/// A wheeled base does not slide: the chord between two poses of an arc lies along their mean heading, h_k of (2.33).
/// r = displacement across the mean heading [m].
struct NonholonomicCost {
  template <class Add>
  void evaluate(const Interval& i, Add&& add) const {
    add(i.aside, MotionGradient{0, 0, 1, 0});
  }
};

}  // namespace sidestep
