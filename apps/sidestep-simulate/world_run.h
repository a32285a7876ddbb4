// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "common/program.h"
#include "sidestep-simulate/simulate_config.h"

namespace sidestep {

/// Runs a world scenario into `folder`: run.rawlog, trajectory.png, metrics.json, run.mp4 if asked for.
/// @param inputs  the files that the scenario names, as `readWorldInputs` reads them
ExitCode runWorld(const SimulateOptions& options, const Scenario& config, const WorldInputs& inputs,
                  const OutputFolder& folder);

}  // namespace sidestep
