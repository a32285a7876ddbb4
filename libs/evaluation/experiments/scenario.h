// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "evaluation/experiments/world_scenario.h"
#include "simulation/localization_scenario.h"

namespace sidestep {

/// All that a scenario file may hold; what reads such files reads them by this.
struct Scenario {
  std::string kind = "localization";
  int seed = 1;
  LocalizationScenarioParams localization;
  WorldScenario world;

  /// @throws ConfigError, DatasetError as readYaml.
  static Scenario read(const std::string& file);
  /// One of that kind to begin with: of a world a room, a robot and somebody who walks.
  static Scenario exampleOf(const std::string& kind);
  /// Shows what belongs to `kind`.
  void visit(ParamVisitor& v);
  /// @throws ConfigError for what the ranges of single parameters do not catch.
  void check() const;
};

/// The text of a file, "" if it cannot be read.
std::string textOf(const std::string& file);

/// Reads a scenario that must be a world.
/// @throws ConfigError as Scenario::read, or if it is of another kind.
WorldScenario readWorldScenario(const std::string& file);

}  // namespace sidestep
