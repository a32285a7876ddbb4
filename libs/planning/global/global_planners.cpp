// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/global_planners.h"

#include "core/errors.h"
#include "planning/global/any_angle_planner.h"

namespace sidestep {

void GlobalPlannerParams::visit(ParamVisitor& v) {
  v.number("clearance_m", clearance_m, {0.01, 100}, "m", "between the robot's centre and all obstacles");
  v.section("grid", "planners on cells: astar, theta, dijkstra", [this](ParamVisitor& w) { grid.visit(w); });
  v.section("sampling", "OMPL's planners", [this](ParamVisitor& w) { sampling.visit(w); });
}

const std::vector<std::string>& globalPlanners() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> out = {"astar", "theta", "dijkstra"};
    out.insert(out.end(), samplingPlanners().begin(), samplingPlanners().end());
    return out;
  }();
  return words;
}

std::unique_ptr<GlobalPlanner> makeGlobalPlanner(const std::string& word, std::shared_ptr<const PlanningGrid> grid,
                                                 const GlobalPlannerParams& params) {
  if (word == "astar") return std::make_unique<GridPlanner>(std::move(grid), params.grid, true);
  if (word == "dijkstra") return std::make_unique<GridPlanner>(std::move(grid), params.grid, false);
  if (word == "theta") return std::make_unique<AnyAnglePlanner>(std::move(grid), params.grid);
  for (const auto& known : samplingPlanners())
    if (word == known) return makeSamplingPlanner(word, std::move(grid), params.sampling);
  const auto near = nearestWord(word, globalPlanners());
  throw ConfigError("'" + word + "' is no planner" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

}  // namespace sidestep
