// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/planner_driver.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

class PlannerDriver final : public Driver {
 public:
  PlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits, const DriverParams& params,
                PlanWatch watch)
      : planner_(std::move(planner)),
        limits_(limits),
        tracking_(params.tracking),
        predictor_(params.tracking.prediction),
        route_(params.path, limits.radius_m),
        watch_(std::move(watch)) {}

  mrpt::math::TTwist2D drive(const DriverView& view) override {
    PlanInput input;
    input.time_s = view.time_s;
    input.pose = view.pose;
    input.twist = view.twist;
    input.goal = view.goal;
    input.path = route_.at(view);
    input.walls = view.walls;
    input.moving = moving(view);
    input.limits = limits_;
    input.period_s = view.period_s;
    if (view.delay_s > 0) lookAhead(view, input);
    planner_->plan(input, out_);
    if (watch_) watch_(input, out_);
    return out_.command;
  }

 private:
  /// What is ordered now shows after `delay_s`: plans from there. Until then the base goes on about as it moves and was
  /// ordered, and what it was ordered it will do; a window around how it moves now would hardly let it speed up.
  static void lookAhead(const DriverView& view, PlanInput& input) {
    const double v = 0.5 * (view.twist.vx + view.ordered.vx), w = 0.5 * (view.twist.omega + view.ordered.omega);
    input.pose = alongArc(view.pose, v * view.delay_s, w * view.delay_s);
    input.twist = view.ordered;
  }
  /// Those who move, where they are when the base does what is ordered now.
  std::span<const MovingObstacle> moving(const DriverView& view) {
    if (tracking_.filter != "none") {
      for (const auto& o : view.moving) {
        const double said = std::sqrt(std::max(o.covariance(0, 0), 0.0));
        predictor_.observe(view.time_s, o.id, o.position, said > 0 ? said : tracking_.position_sd_m, o.radius_m);
      }
      predictor_.predict(view.time_s + view.delay_s, moving_);
      return moving_;
    }
    if (view.delay_s <= 0) return view.moving;
    moving_.assign(view.moving.begin(), view.moving.end());
    for (MovingObstacle& m : moving_) m.position += m.velocity * view.delay_s;
    return moving_;
  }

  std::unique_ptr<LocalPlanner> planner_;
  RobotLimits limits_;
  TrackingParams tracking_;
  MotionPredictor predictor_;
  GlobalRoute route_;
  PlanWatch watch_;
  PlanOutput out_;
  std::vector<MovingObstacle> moving_;
};

}  // namespace

void TrackingParams::visit(ParamVisitor& v) {
  v.choice("filter", filter, {"none", "constant_velocity"},
           "planners get positions and velocities as perceived; or what a Kalman filter makes of the positions, with "
           "predicted paths and their covariance");
  v.number("position_sd_m", position_sd_m, {0.001, 10}, "m", "noise of a position whose perception says nothing of it");
  v.section("prediction", "the Kalman filter", [this](ParamVisitor& s) { prediction.visit(s); });
}

void DriverParams::visit(ParamVisitor& v) {
  planners.visit(v);
  v.section("tracking", "what planners are told of those who move", [this](ParamVisitor& s) { tracking.visit(s); });
  v.section("path", "the global path that planners are given", [this](ParamVisitor& s) { path.visit(s); });
}

std::unique_ptr<Driver> makePlannerDriver(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                                          const DriverParams& params, PlanWatch watch) {
  return std::make_unique<PlannerDriver>(std::move(planner), limits, params, std::move(watch));
}

DriverFactory plannerDrivers(const DriverParams& params) {
  return [params](const std::string& name, const RobotLimits& limits) -> std::unique_ptr<Driver> {
    return makePlannerDriver(makeLocalPlanner(name, params.planners), limits, params);
  };
}

bool isLocalPlanner(const std::string& name) {
  const auto& rows = localPlanners();
  return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return name == row.name && row.avoids; });
}

}  // namespace sidestep
