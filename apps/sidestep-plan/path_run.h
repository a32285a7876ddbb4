// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/errors.h"
#include "sidestep-plan/path_config.h"

namespace sidestep {

/// Plans the paths that are asked for; leaves path.csv, path.tum, path.png (one query) or paths.csv (a file of them),
/// metrics.json, effective.yaml and command.txt in the output folder, and prints a table.
/// @return kAlgorithmGaveUp if any path is missing
ExitCode planPaths(const PathOptions& options);

}  // namespace sidestep
