// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/scorer.h"

namespace sidestep {

/// How near v is to the speed of the HRVO velocity: where only slowing down helps, its direction alone does not tell.
class HrvoSpeedScorer final : public Scorer {
 public:
  const char* name() const override { return "speed"; }
  double score(const Rollout& rollout, const ScoringView& view) const override;
};

}  // namespace sidestep
