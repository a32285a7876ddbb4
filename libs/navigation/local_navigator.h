// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "navigation/global_route.h"
#include "navigation/situation.h"
#include "perception/motion_predictor.h"
#include "planning/planners.h"

namespace sidestep {

/// What a local planner is told of those who move.
struct TrackingParams {
  std::string filter = "none";  ///< none: as perceived; constant_velocity: positions through a Kalman filter
  double position_sd_m = 0.02;  ///< noise of a perceived position that says nothing of its own
  MotionPredictorParams prediction;

  void visit(ParamVisitor& v);
};

/// Local planners, and what they are told.
struct LocalNavigatorParams {
  LocalPlannerParams planners;
  TrackingParams tracking;
  GlobalRouteParams path;

  LocalNavigatorParams() = default;
  // planners alone are all that most worlds say, hence not explicit
  LocalNavigatorParams(const LocalPlannerParams& p) : planners(p) {}
  void visit(ParamVisitor& v);
};

/// Is told what a planner was asked and what it answered, once a control period.
using PlanWatch = std::function<void(const PlanInput&, const PlanOutput&)>;

/// A local planner and all that it is told: the global path, those who move as tracked and predicted, and, where the
/// base lags behind its commands, the pose at which the next command shows. It knows nothing but the situations given.
class LocalNavigator {
 public:
  LocalNavigator(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                 const LocalNavigatorParams& params = {}, PlanWatch watch = {});

  /// The velocity to command now, in the base frame. Times must not decrease.
  mrpt::math::TTwist2D command(const Situation& now);

 private:
  std::span<const MovingObstacle> moving(const Situation& now);

  std::unique_ptr<LocalPlanner> planner_;
  RobotLimits limits_;
  TrackingParams tracking_;
  MotionPredictor predictor_;
  GlobalRoute route_;
  PlanWatch watch_;
  PlanOutput out_;
  std::vector<MovingObstacle> moving_;
};

/// Whether a local planner of that name considers anything, so that its plans can be watched.
bool isLocalPlanner(const std::string& name);

}  // namespace sidestep
