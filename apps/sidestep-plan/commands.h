// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/errors.h"

namespace sidestep {

/// What band and crossing share: a file of problems, a robot and a planner, for -c and effective.yaml.
struct BandCommandOptions {
  std::string problems, config_file, output, planner = "eteb";
  bool overwrite = false, quiet = false, write_config = false;
  int threads = 1;
};

/// What the chosen subcommand does once the command line is read.
using Work = std::function<ExitCode()>;

/// Each adds its subcommand, in a file of its own, which sets `work` when it is chosen.
void addPathCommand(CLI::App& app, Work& work);
void addBandCommand(CLI::App& app, Work& work);
void addCrossingCommand(CLI::App& app, Work& work);

}  // namespace sidestep
