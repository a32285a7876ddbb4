// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "navigation/local_navigator.h"
#include "simulation/world.h"

namespace sidestep {

/// What a scenario of kind `world` holds: the world, and the parameters of the planners in it.
struct WorldScenario {
  WorldParams world;
  LocalNavigatorParams planners;

  void visit(ParamVisitor& v);
  /// Lays `yaml` over it. Walls, robots and people that it does not name stay, before the new ones.
  /// @param name  stands for the text in messages
  void layOver(const std::string& yaml, const std::string& name);
  /// @throws ConfigError for what the ranges of single parameters do not catch, and for unknown planners.
  void check() const;
};

/// The parameters of the robot under test.
RobotParams& robotUnderTest(WorldParams& world);
const RobotParams& robotUnderTest(const WorldParams& world);

/// Has what the planner of the robot under test is asked and answers told to `watch`; it commands on as the one of
/// `navigatorControllers` would.
/// @param explain  the planner says of each candidate why it lost
/// @return false if that robot has no local planner: nothing is watched
bool watchRobotUnderTest(World& world, const WorldScenario& scenario, bool explain, PlanWatch watch);

/// A file that a scenario names: ${NAME} is the environment's; a relative path is meant from here or, if nothing is
/// there, from the scenario's own folder.
std::string scenarioPath(const std::string& path, const std::string& scenario_file);

/// Reads the map and the recorded people that a world names.
/// @throws DatasetError if one of them cannot be read.
WorldInputs readWorldInputs(const WorldParams& params, const std::string& scenario_file);

}  // namespace sidestep
