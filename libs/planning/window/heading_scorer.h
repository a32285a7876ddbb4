// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/scorer.h"

namespace sidestep {

/// Target heading (2.27): 180 deg less the angle between the heading predicted after `after_s` and the direction from
/// there to the goal, over 180 deg.
class HeadingScorer final : public Scorer {
 public:
  explicit HeadingScorer(double after_s) : after_s_(after_s) {}
  const char* name() const override { return "heading"; }
  double score(const Rollout& rollout, const ScoringView& view) const override;

 private:
  double after_s_;
};

}  // namespace sidestep
