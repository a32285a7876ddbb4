// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/obstacles.h"
#include "core/params.h"

namespace sidestep {

/// Obstacles of one problem.
struct BandProblemCase {
  int n_obs = 0, seed = 0;
  std::vector<MovingObstacle> obstacles;
};

/// Reads a CSV with the header n_obs,seed,i,x,y,vx,vy or seed,i,x,y,vx,vy; rows of one problem follow each other.
/// @throws DatasetError with file and line if it is missing or a row is not what the header says
std::vector<BandProblemCase> readProblems(const std::string& file, bool with_count, double radius_m);

/// What both commands share: a robot and a planner, for -c and effective.yaml.
struct BandCommandOptions {
  std::string problems, config_file, output, planner = "eteb";
  bool overwrite = false, quiet = false, write_config = false;
  int threads = 1;
};

}  // namespace sidestep
