// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdexcept>
#include <string>

namespace sidestep {

/// Exit codes of every program; doc/programs.md is their table.
enum class ExitCode : int {
  kDone = 0,
  kInternalError = 1,
  kUsage = 2,
  kInputMissing = 3,
  kInputCorrupt = 4,
  kAlgorithmGaveUp = 5,
  kThresholdMissed = 6,
  kHardwareFault = 7,
  kInterrupted = 130
};

/// An error that a program prints as its one line (what, where, what to do) and turns into its exit code.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// Wrong option, parameter or configuration file.
struct ConfigError : Error {
  explicit ConfigError(const std::string& line) : Error(ExitCode::kUsage, line) {}
};

/// Input that is not there, or that is damaged.
struct DatasetError : Error {
  using Error::Error;
  static DatasetError missing(const std::string& line) { return {ExitCode::kInputMissing, line}; }
  static DatasetError corrupt(const std::string& line) { return {ExitCode::kInputCorrupt, line}; }
};

}  // namespace sidestep
