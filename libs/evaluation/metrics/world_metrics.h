// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "evaluation/metrics/metric.h"
#include "planning/local_planner.h"
#include "simulation/world.h"

namespace sidestep {

/// Plans of the robot under test.
struct PlanCount {
  size_t all = 0, braked = 0;
  void add(const PlanOutput& out) {
    ++all;
    if (out.status == PlanOutput::Status::kBraking || out.status == PlanOutput::Status::kNoPlan) ++braked;
  }
};

/// What a run of a world adds up to, of the robot under test.
struct WorldNumbers {
  WorldSummary summary;
  double largest_index = 0, above_threshold_s = 0, standing_s = 0;  ///< WorldRecorder
  PlanCount plans;
};

/// The rows of studies of kind `world`, and of metrics.json of sidestep-simulate.
const Metrics<WorldNumbers>& worldMetrics();

}  // namespace sidestep
