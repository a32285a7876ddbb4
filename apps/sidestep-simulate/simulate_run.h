// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/errors.h"
#include "sidestep-simulate/simulate_config.h"

namespace sidestep {

/// One run of a scenario into an output folder.
ExitCode simulate(const SimulateOptions& options);

}  // namespace sidestep
