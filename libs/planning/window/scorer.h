// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/rollout.h"

namespace sidestep {

/// One term of the objective function (2.26), (4.3). A scorer knows neither weights nor other scorers.
class Scorer {
 public:
  virtual ~Scorer() = default;
  virtual const char* name() const = 0;
  /// In [0, 1], 1 = best. A pure function.
  virtual double score(const Rollout& rollout, const ScoringView& view) const = 0;
};

}  // namespace sidestep
