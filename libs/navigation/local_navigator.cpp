// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/local_navigator.h"

#include <algorithm>
#include <cmath>

#include "core/kinematics.h"

namespace sidestep {
namespace {

/// What is commanded now shows after `delay_s`: plans from there. Until then the base goes on about as it moves and was
/// commanded, and what it was commanded it will do; a window around how it moves now would hardly let it speed up.
void lookAhead(const Situation& now, PlanInput& input) {
  const double v = 0.5 * (now.twist.vx + now.commanded.vx), w = 0.5 * (now.twist.omega + now.commanded.omega);
  input.pose = alongArc(now.pose, v * now.delay_s, w * now.delay_s);
  input.twist = now.commanded;
}

}  // namespace

void TrackingParams::visit(ParamVisitor& v) {
  v.choice("filter", filter, {"none", "constant_velocity"},
           "planners get positions and velocities as perceived; or what a Kalman filter makes of the positions, with "
           "predicted paths and their covariance");
  v.number("position_sd_m", position_sd_m, {0.001, 10}, "m", "noise of a position whose perception says nothing of it");
  v.section("prediction", "the Kalman filter", [this](ParamVisitor& s) { prediction.visit(s); });
}

void LocalNavigatorParams::visit(ParamVisitor& v) {
  planners.visit(v);
  v.section("tracking", "what planners are told of those who move", [this](ParamVisitor& s) { tracking.visit(s); });
  v.section("path", "the global path that planners are given", [this](ParamVisitor& s) { path.visit(s); });
}

LocalNavigator::LocalNavigator(std::unique_ptr<LocalPlanner> planner, const RobotLimits& limits,
                               const LocalNavigatorParams& params, PlanWatch watch)
    : planner_(std::move(planner)),
      limits_(limits),
      tracking_(params.tracking),
      predictor_(params.tracking.prediction),
      route_(params.path, limits.radius_m),
      watch_(std::move(watch)) {}

mrpt::math::TTwist2D LocalNavigator::command(const Situation& now) {
  PlanInput input;
  input.time_s = now.time_s;
  input.pose = now.pose;
  input.twist = now.twist;
  input.goal = now.goal;
  input.path = route_.at(now);
  input.walls = now.walls;
  input.moving = moving(now);
  input.limits = limits_;
  input.period_s = now.period_s;
  if (now.delay_s > 0) lookAhead(now, input);
  planner_->plan(input, out_);
  if (watch_) watch_(input, out_);
  return out_.command;
}

/// Those who move, where they are when the base does what is commanded now.
std::span<const MovingObstacle> LocalNavigator::moving(const Situation& now) {
  if (tracking_.filter != "none") {
    for (const auto& o : now.moving) {
      const double said = std::sqrt(std::max(o.covariance(0, 0), 0.0));
      predictor_.observe(now.time_s, o.id, o.position, said > 0 ? said : tracking_.position_sd_m, o.radius_m);
    }
    predictor_.predict(now.time_s + now.delay_s, moving_);
    return moving_;
  }
  if (now.delay_s <= 0) return now.moving;
  moving_.assign(now.moving.begin(), now.moving.end());
  for (MovingObstacle& m : moving_) m.position += m.velocity * now.delay_s;
  return moving_;
}

bool isLocalPlanner(const std::string& name) {
  const auto& rows = localPlanners();
  return std::any_of(rows.begin(), rows.end(), [&](const auto& row) { return name == row.name && row.avoids; });
}

}  // namespace sidestep
