// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/scorer.h"

namespace sidestep {

/// The heading of EDWA (4.1)-(4.2), over 180 deg.
///
/// As printed, (4.1) compares the direction from the predicted *position* to the goal with that of the HRVO velocity.
/// The more the robot steps to one side, the more that direction turns to the other, so the printed form rewards
/// stepping to the wrong side. What the text means is the predicted *heading* against the direction of the HRVO
/// velocity: `aligned`.
class HrvoHeadingScorer final : public Scorer {
 public:
  HrvoHeadingScorer(double after_s, bool printed) : after_s_(after_s), printed_(printed) {}
  const char* name() const override { return "heading"; }
  double score(const Rollout& rollout, const ScoringView& view) const override;

 private:
  double after_s_;
  bool printed_;
};

}  // namespace sidestep
