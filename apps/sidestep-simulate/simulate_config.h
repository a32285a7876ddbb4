// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/params.h"
#include "evaluation/experiments/world_scenario.h"
#include "simulation/localization_scenario.h"

namespace sidestep {

/// What the command line says.
struct SimulateOptions {
  std::string scenario, output = "out";
  std::optional<int> seed;
  std::vector<std::string> planners;  ///< of the first robot, instead of the scenario's; more than one: for snapshots
  std::vector<double> snapshots_s;
  bool overwrite = false, quiet = false, no_picture = false, video = false, explain = false, write_config = false;
};

/// All that a scenario file may hold.
struct SimulateConfig {
  std::string kind = "localization";
  int seed = 1;
  LocalizationScenarioParams localization;
  WorldScenario world;

  /// Shows what belongs to `kind`.
  void visit(ParamVisitor& v);
  /// @throws ConfigError for what the ranges of single parameters do not catch.
  void check() const;
};

/// The scenario file's values, with those of the command line over them.
/// @throws ConfigError, DatasetError as readYaml.
SimulateConfig effectiveConfig(const SimulateOptions& options);

}  // namespace sidestep
