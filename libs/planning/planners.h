// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "planning/band/band_planner.h"
#include "planning/local_planner.h"
#include "planning/velocity/hrvo_planner.h"
#include "planning/window/window_planner.h"

namespace sidestep {

/// Parameters of every local planner; each reads its own section.
struct LocalPlannerParams {
  WindowParams dwa;
  HrvoPlannerParams hrvo;
  EdwaParams edwa;
  BandPlannerParams band;

  void visit(ParamVisitor& v);
};

/// The names of all local planners.
std::vector<std::string> localPlannerNames();

/// The planner of that name. Adding one: a line in the table of planners.cpp, a section above.
/// @throws ConfigError for an unknown name, with the nearest known one
std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name, const LocalPlannerParams& params);
/// The same with default parameters.
std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name);

}  // namespace sidestep
