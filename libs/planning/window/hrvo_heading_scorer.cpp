// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/window/hrvo_heading_scorer.h"

#include "core/geometry.h"
#include "core/kinematics.h"

namespace sidestep {

double HrvoHeadingScorer::score(const Rollout& rollout, const ScoringView& view) const {
  const auto p = arcFromOrigin(rollout.v * after_s_, rollout.w * after_s_);
  const double compared = printed_ ? std::atan2(view.goal_y - p.y, view.goal_x - p.x) : p.phi;
  return 1 - std::abs(wrapped(compared - view.adviser_heading)) / M_PI;
}

}  // namespace sidestep
