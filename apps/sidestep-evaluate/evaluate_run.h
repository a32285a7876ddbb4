// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace sidestep {

struct EvaluateOptions {
  std::string study, output = "sidestep-evaluate-out";
  std::vector<std::string> scenarios;
  int jobs = 0;  ///< 0: one a core
  std::optional<int> seed, runs;
  bool overwrite = false, resume = false, quiet = false, write_config = false;
};

/// All runs of a study, their tables, figures and report.
ExitCode evaluate(const EvaluateOptions& options);

}  // namespace sidestep
