// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "core/errors.h"
#include "core/params.h"

namespace sidestep {

/// What every program does alike: parses (a misspelt option is an error that names the nearest), answers --help and
/// --version, runs `work`, and turns what it throws into one line on stderr and an exit code.
int runProgram(int argc, char** argv, CLI::App& app, const std::function<ExitCode()>& work);

/// True once the user has pressed Ctrl-C or the program was asked to end: finish what is in hand, save it, return
/// ExitCode::kInterrupted.
bool interrupted();

/// The command line as typed, quoted so that a shell takes it back.
const std::string& commandLine();

/// A bar with the time left, on stderr when that is a terminal and `quiet` is not set; else nothing.
class ProgressBar {
 public:
  ProgressBar(std::string what, bool quiet);
  ~ProgressBar();
  void update(double fraction);

 private:
  std::string what_;
  bool shown_;
  double started_s_, last_s_ = 0;
};

/// A folder for results: created if need be, never written into when it holds something unless `overwrite`.
/// `writeConfiguration` leaves effective.yaml and command.txt in it.
class OutputFolder {
 public:
  /// @throws ConfigError if the folder holds something and `overwrite` is not set.
  OutputFolder(const std::string& path, bool overwrite);
  std::string file(const std::string& name) const;
  void writeText(const std::string& name, const std::string& text) const;
  void writeConfiguration(const Visit& fields) const;

 private:
  std::string path_;
};

}  // namespace sidestep
