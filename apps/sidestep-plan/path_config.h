// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <optional>
#include <string>
#include <vector>

#include "maps/grid_map.h"
#include "maps/map_file.h"
#include "planning/global/global_planners.h"
#include "planning/global/path_smoother.h"

namespace sidestep {

/// All that a YAML for `sidestep-plan path` may hold.
struct PathConfig {
  std::string planner = "astar";
  bool smooth = false;
  Table footprint;              ///< x, y of its corners in the base frame [m]; empty: planning.clearance_m says it all
  double nearest_within_m = 5;  ///< how far start and goal may be moved when that is asked for
  MapReadParams map;
  ObstacleParams obstacles;
  DistanceFieldParams field;
  GlobalPlannerParams planning;
  SmoothingParams smoothing;

  void visit(ParamVisitor& v);
};

/// What the command line of `sidestep-plan path` says.
struct PathOptions {
  std::string map, start, goal, footprint, pairs_file, config_file, output = "sidestep-plan-out", planner, space;
  std::optional<double> clearance_m, resolution_m, time_s;
  std::optional<int> seed;
  bool all = false, nearest = false, smooth = false, overwrite = false, quiet = false, no_picture = false;
  bool write_config = false;
};

/// Start and goal of one query.
struct PathPair {
  mrpt::math::TPose2D start, goal;
};

/// The file's parameters with the command line's on top. @throws ConfigError for anything that does not fit.
PathConfig effectivePathConfig(const PathOptions& options);

/// The pairs that the options ask for: one of --start and --goal, or those of a file.
/// @throws ConfigError, DatasetError `file:line: what is wrong`.
std::vector<PathPair> readPairs(const PathOptions& options);

}  // namespace sidestep
