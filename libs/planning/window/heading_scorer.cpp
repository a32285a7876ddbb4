// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/heading_scorer.h"

#include "core/geometry.h"
#include "core/kinematics.h"

namespace sidestep {

double HeadingScorer::score(const Rollout& rollout, const ScoringView& view) const {
  const auto p = arcFromOrigin(rollout.v * after_s_, rollout.w * after_s_);
  return 1 - std::abs(wrapped(std::atan2(view.goal_y - p.y, view.goal_x - p.x) - p.phi)) / M_PI;
}

}  // namespace sidestep
