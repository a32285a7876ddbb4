// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "planning/goal_approach.h"
#include "planning/velocity/hrvo.h"

namespace sidestep {

struct HrvoPlannerParams {
  GoalParams goal;
  HrvoParams hrvo;
  double align_s = 0.8;

  void visit(ParamVisitor& v);
};

/// Drives the velocity (2.29) with a differential drive: `HrvoSight`, then `driveFor`, then what is reachable.
/// Explains itself with the points of the velocity plane that came into question, as straight trajectories.
std::unique_ptr<LocalPlanner> makeHrvoPlanner(const HrvoPlannerParams& params);

}  // namespace sidestep
