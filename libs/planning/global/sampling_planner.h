// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/params.h"
#include "planning/global/global_planner.h"
#include "planning/global/planning_grid.h"

namespace sidestep {

struct SamplingParams {
  std::string space = "se2";      ///< straight lines; or "dubins", "reeds-shepp": arcs of the turning radius
  double turning_radius_m = 0.5;  ///< of dubins and reeds-shepp [m]
  double time_s = 1;              ///< allowed for a path; planners that improve their path use all of it [s]
  int iterations = 0;             ///< ends after so many looks at the clock instead; 0: only the time counts
  int seed = 1;

  void visit(ParamVisitor& v);
};

/// Words for the planners of OMPL that are known here.
const std::vector<std::string>& samplingPlanners();

/// Why a planner of OMPL's cannot plan in a space, in words; empty if it can.
std::string refusesSpace(const std::string& word, const std::string& space);

/// A planner of OMPL's (Sucan, Moll & Kavraki 2012), by its word: rrtconnect, rrtstar, informed-rrtstar, bitstar,
/// prmstar, kpiece.
///
/// Each query draws its random numbers anew from the seed. With `iterations` and time enough, the same query gives the
/// same path; a path that the time ended depends on the machine, and prmstar's always does (OMPL runs it in two
/// threads). rrtconnect and kpiece end with the first path and shorten it; the others use all the time. OMPL has one
/// seed for the whole process: not for several threads at once. Headings of "se2" are those along the way, as the base
/// can turn on the spot; arcs keep the headings of start and goal.
/// @throws ConfigError for a word that is not known, and for one that refusesSpace.
std::unique_ptr<GlobalPlanner> makeSamplingPlanner(const std::string& word, std::shared_ptr<const PlanningGrid> grid,
                                                   const SamplingParams& params);

}  // namespace sidestep
