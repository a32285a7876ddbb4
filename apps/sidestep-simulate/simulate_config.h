// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/experiments/scenario.h"

namespace sidestep {

/// What the command line says.
struct SimulateOptions {
  std::string scenario, output = "out", kind;
  std::optional<int> seed;
  std::vector<std::string>
      planners;  ///< of the robot under test, instead of the scenario's; more than one: for snapshots
  std::vector<double> snapshots_s;
  bool overwrite = false, quiet = false, no_picture = false, video = false, explain = false, write_config = false,
       force = false;
};

/// The scenario file's values, with those of the command line over them.
/// @throws ConfigError, DatasetError as readYaml.
Scenario effectiveScenario(const SimulateOptions& options);

}  // namespace sidestep
