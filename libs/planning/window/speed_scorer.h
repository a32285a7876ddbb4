// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/scorer.h"

namespace sidestep {

/// vel(v, w) of (2.26): v over the largest v.
class SpeedScorer final : public Scorer {
 public:
  const char* name() const override { return "speed"; }
  double score(const Rollout& rollout, const ScoringView& view) const override;
};

}  // namespace sidestep
