// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>

#include "datasets/problem_file.h"
#include "perception/motion_predictor.h"
#include "planning/local_planner.h"

namespace sidestep {

struct CrossingRow {
  int seed = 0;
  std::string outcome;  ///< goal, contact, timeout
  double time_s = 0, min_clearance_m = 0;
  std::vector<double> plan_ms;
  bool outside_limits = false;  ///< of any command
  int braked = 0;               ///< plans that braked
};

/// Closed loop: robot (0, 0, 0) -> (10, 0), six discs that cross blindly at constant velocity; 0.05 s simulation, 10 Hz
/// planning. The planner gets positions and what a Kalman filter makes of them.
struct CrossingRun {
  RobotLimits robot;
  MotionPredictorParams predictor;
  double goal_m = 0.3, time_max_s = 60;
  std::function<double()> cpu_ms;
};
CrossingRow runCrossing(const PlanningProblem& problem, const CrossingRun& run, LocalPlanner& planner);

}  // namespace sidestep
