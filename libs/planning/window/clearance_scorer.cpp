// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/clearance_scorer.h"

#include <algorithm>

namespace sidestep {

double ClearanceScorer::score(const Rollout& rollout, const ScoringView& view) const {
  if (!(rollout.free_s < view.look_ahead_s)) return 1;
  return std::min(1.0, rollout.v * rollout.free_s / (view.v_max * view.look_ahead_s));
}

}  // namespace sidestep
