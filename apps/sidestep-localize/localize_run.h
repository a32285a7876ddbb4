// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/errors.h"
#include "sidestep-localize/localize_config.h"

namespace sidestep {

/// Runs a filter over a log and leaves estimate.rawlog, trajectory.tum, trajectory.png, metrics.json, effective.yaml
/// and command.txt in the output folder; prints the table of errors. Memory does not grow with the log.
ExitCode localize(const LocalizeOptions& options);

}  // namespace sidestep
