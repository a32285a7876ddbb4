// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "evaluation/metrics/metric.h"
#include "simulation/world.h"

namespace sidestep {

/// What a run of a world adds up to, of its first robot.
struct WorldNumbers {
  WorldSummary summary;
  double largest_index = 0, above_threshold_s = 0, standing_s = 0;  ///< WorldRecorder
  size_t plans = 0, braked = 0;                                     ///< of its planner
};

/// The rows of studies of kind `world`, and of metrics.json of sidestep-simulate.
const Metrics<WorldNumbers>& worldMetrics();

}  // namespace sidestep
