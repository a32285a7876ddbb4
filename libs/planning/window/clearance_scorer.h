// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/window/scorer.h"

namespace sidestep {

/// dist(v, w) of (2.26): the way until the arc touches something, over the way at full speed in the look-ahead; 1 if it
/// touches nothing. A slow rollout that is free as long as a fast one has the shorter way.
class ClearanceScorer final : public Scorer {
 public:
  const char* name() const override { return "clearance"; }
  double score(const Rollout& rollout, const ScoringView& view) const override;
};

}  // namespace sidestep
