// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "evaluation/study/study_runner.h"

namespace sidestep {

/// Studies of kind `world`: a scenario is a world of sidestep-simulate (`file`, `set`); an algorithm says which
/// planners the robot under test (`robot`) and the others (`others`) have, and what it changes besides (`set`).
std::unique_ptr<StudyRunner> makeWorldRunner(const std::string& study_file);

}  // namespace sidestep
