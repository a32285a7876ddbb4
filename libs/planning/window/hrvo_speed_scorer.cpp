// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/hrvo_speed_scorer.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

double HrvoSpeedScorer::score(const Rollout& rollout, const ScoringView& view) const {
  return 1 - std::min(1.0, std::abs(rollout.v - view.adviser_speed) / view.v_max);
}

}  // namespace sidestep
