// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>

#include "datasets/problem_file.h"
#include "planning/band/band_planner.h"

namespace sidestep {

/// A row of results.csv.
struct BandResult {
  int n_obs = 0, seed = 0;
  std::string status;  ///< clear, contact, none
  double time_ms = 0, warm_ms = 0;
  int poses = 0;
  double transition_s = 0, min_dist_m = 0, max_v = 0, max_w = 0, max_a = 0, max_alpha = 0, cost = 0;
  int classes = 0;
  std::string way_exists;  ///< WayVerdict, "" if not asked for
  double least_s = 0;
};

/// How a problem is solved: start (0, 0, 0) at rest, goal (8, 0), point obstacles.
struct BandBenchmark {
  RobotLimits robot;
  bool moving = false;
  int repeats = 5, replans = 50;
  std::function<double()> cpu_ms;  ///< a clock
  std::function<void(const PlanningProblem&, const BandPlanner&)>
      planned_cold;                                                          ///< told after the cold plan; may be empty
  std::function<void(const PlanningProblem&, const PlanOutput&)> explained;  ///< the same
};

/// Plans cold `repeats` times, then `replans` times while the robot drives what was ordered and obstacles move on.
BandResult benchmarkBand(const PlanningProblem& problem, const BandBenchmark& run, BandPlanner& planner);

}  // namespace sidestep
