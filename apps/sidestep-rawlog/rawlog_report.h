// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "datasets/log_degrader.h"
#include "datasets/log_health.h"
#include "datasets/log_recovery.h"

namespace sidestep {

/// Text from a file, with nothing in it that could steer the terminal.
std::string printable(std::string text);

/// A table of the labels, what was refused, and the verdict with its reasons.
std::string healthText(const LogHealth& health);
/// The same for programs.
std::string healthJson(const LogHealth& health);

std::string recoveryText(const RecoveryReport& report, const std::string& out);
std::string recoveryJson(const RecoveryReport& report, const std::string& out);

/// What degrading a log came to.
struct DegradeReport {
  uint64_t read = 0, written = 0;
  std::vector<LogDegrader::EventCount> events;
};
std::string degradeText(const DegradeReport& report, const std::string& out);
std::string degradeJson(const DegradeReport& report, const std::string& out);

}  // namespace sidestep
