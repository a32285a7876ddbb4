// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "evaluation/study/study_runner.h"

namespace sidestep {

/// Studies of kind `localization`: a scenario is a simulated drive (`file`, `set`) or a real log (`log`), with a
/// robot's configuration and perhaps an interruption of signals; an algorithm is what it changes in that configuration.
std::unique_ptr<StudyRunner> makeLocalizationRunner(const std::string& study_file);

}  // namespace sidestep
