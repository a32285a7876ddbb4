// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "navigation/global_route.h"
#include "perception/motion_predictor.h"
#include "planning/planners.h"
#include "simulation/driver.h"

namespace sidestep {

/// What a local planner is told of those who move.
struct TrackingParams {
  std::string filter = "none";  ///< none: as perceived; constant_velocity: positions through a Kalman filter
  double position_sd_m = 0.02;  ///< noise of a perceived position that says nothing of its own
  MotionPredictorParams prediction;

  void visit(ParamVisitor& v);
};

/// Local planners, and what they are told.
struct DriverParams {
  LocalPlannerParams planners;
  TrackingParams tracking;
  GlobalRouteParams path;

  DriverParams() = default;
  // planners alone are all that most worlds say, hence not explicit
  DriverParams(const LocalPlannerParams& p) : planners(p) {}
  void visit(ParamVisitor& v);
};

/// Is told what a planner was asked and what it answered, once a control period.
using PlanWatch = std::function<void(const PlanInput&, const PlanOutput&)>;

/// A local planner at the wheel of a simulated robot: goes for the goal with what is perceived, and knows nothing else.
/// Where the base is behind its orders (lag, latency), it plans from where the robot will be by then.
std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                          const DriverParams& params = {}, PlanWatch watch = {});

/// Makes the drivers of a world's robots: local planners by name. The factory may outlive `params`.
/// @throws ConfigError when called with a name that is none, with all names
DriverFactory plannerDrivers(const DriverParams& params);

/// Whether a local planner of that name considers anything, so that its plans can be watched.
bool isLocalPlanner(const std::string& name);

}  // namespace sidestep
