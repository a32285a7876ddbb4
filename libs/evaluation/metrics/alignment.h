// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "evaluation/metrics/trajectory_error.h"
#include "localization/configuration.h"

namespace sidestep {

/// How an estimate is laid onto the truth: as the configuration says; `auto` moves nothing where estimate and truth are
/// in one known frame, else judges the filter by shape: least squares where it was told positions, the first pose where
/// not. The one rule for program and study.
/// @param sensors  what was used
Alignment alignmentFor(const LocalizeConfig& config, const std::vector<SensorUse>& sensors);

}  // namespace sidestep
