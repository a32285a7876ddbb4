// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/obstacles.h"

namespace sidestep {

/// Obstacles of one problem for a local planner.
struct PlanningProblem {
  int n_obs = 0, seed = 0;
  std::vector<MovingObstacle> obstacles;
};

/// Reads a CSV with the header n_obs,seed,i,x,y,vx,vy or seed,i,x,y,vx,vy; rows of one problem follow each other.
/// @throws DatasetError with file and line if it is missing or a row is not what the header says
std::vector<PlanningProblem> readProblems(const std::string& file, bool with_count, double radius_m);

}  // namespace sidestep
