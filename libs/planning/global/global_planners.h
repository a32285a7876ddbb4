// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "planning/global/global_planner.h"
#include "planning/global/grid_search.h"
#include "planning/global/sampling_planner.h"

namespace sidestep {

struct GlobalPlannerParams {
  double clearance_m = 0.3;  ///< of the robot's centre [m]
  GridSearchParams grid;
  SamplingParams sampling;

  void visit(ParamVisitor& v);
};

/// Words of all planners, in the order of tables: astar, theta, dijkstra, then OMPL's.
const std::vector<std::string>& globalPlanners();

/// @throws ConfigError for a word that is not known, naming the nearest.
std::unique_ptr<GlobalPlanner> makeGlobalPlanner(const std::string& word, std::shared_ptr<const PlanningGrid> grid,
                                                 const GlobalPlannerParams& params);

}  // namespace sidestep
