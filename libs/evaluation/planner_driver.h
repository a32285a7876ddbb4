// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>

#include "evaluation/route.h"
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
  RouteParams route;

  DriverParams() = default;
  // planners alone are all that most worlds say, hence not explicit
  DriverParams(const LocalPlannerParams& p) : planners(p) {}
  void visit(ParamVisitor& v);
};

/// Told of each plan; the candidates are there.
using PlanWatch = std::function<void(const PlanInput&, const PlanOutput&)>;

/// A local planner at the wheel of a simulated robot: goes for the goal with what is perceived, and knows nothing else.
/// @param watch  told of each plan; may be empty
std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                          const DriverParams& params = {}, const PlanWatch& watch = {});
/// The same by name, or what `makeSimpleDriver` makes, which is not watched.
/// @throws ConfigError for a name that is neither, with all names
std::unique_ptr<Driver> makeDriver(const std::string& name, const RobotLimits& limits, const DriverParams& params,
                                   const PlanWatch& watch = {});

/// `makeDriver` for the robots of a world. The factory may outlive `params`.
DriverFactory plannerDrivers(const DriverParams& params);

}  // namespace sidestep
