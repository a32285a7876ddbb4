// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "localization/configuration.h"

namespace sidestep {

/// What is asked for on the command line.
struct LocalizeOptions {
  std::string log, config_file, output = "sidestep-localize-out", ground_truth, initial_pose;
  std::string filter, sensors, align, map;
  std::vector<std::string> labels;
  double from_s = 0, to_s = 1e18;
  bool overwrite = false, quiet = false, write_config = false, no_picture = false, smooth = false;
  std::optional<int> seed;
};

/// The file's parameters with the command line's on top.
/// @throws ConfigError for anything that is not known or does not fit.
LocalizeConfig effectiveConfig(const LocalizeOptions& options);

}  // namespace sidestep
