// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/speed_scorer.h"

namespace sidestep {

double SpeedScorer::score(const Rollout& rollout, const ScoringView& view) const { return rollout.v / view.v_max; }

}  // namespace sidestep
