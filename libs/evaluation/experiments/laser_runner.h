// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>

#include "evaluation/study/study_runner.h"

namespace sidestep {

/// Studies of kind `laser`: localizers by laser in a map, on pieces of recorded drives, or of drives made on a map.
/// Scenarios name log and map, or a map to drive on, and how the localizer is put to the test; algorithms change their
/// configuration. Metrics are those of laserMetrics().
std::unique_ptr<StudyRunner> makeLaserRunner(const std::string& study_file);

}  // namespace sidestep
