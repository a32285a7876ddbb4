// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "planning/planners.h"

/// Encounters of discs on an empty plane, as in section 4.1 of the dissertation: a small world for tests and tuning.
namespace sidestep::support {

/// A disc that drives differentially to its goal; actor 0 is the robot.
struct Actor {
  std::string planner;  ///< of makeLocalPlanner; "straight": goes on at v_max whatever comes
  mrpt::math::TPose2D pose;
  mrpt::math::TPoint2D goal;
  bool sees_robot = true;
  double v = 0, w = 0;  ///< at the start
};

struct Encounter {
  std::vector<Actor> actors;
  RobotLimits limits;
  LocalPlannerParams robot, others;  ///< parameters of the planners
  double period_s = 0.25, sight_m = 8, field_of_view = 1.5 * M_PI;
  double patience_s = 60;
};

struct EncounterResult {
  bool reached = false, collided = false;
  double time_s = 0, way_m = 0, clearance_m = std::numeric_limits<double>::infinity();
  double average_velocity() const { return time_s > 0 ? way_m / time_s : 0; }
  double delta_min() const { return std::exp(-std::max(0.0, clearance_m) * std::max(0.0, clearance_m) / 3); }  // (4.6)
};

/// Called after each period with the time and all actors.
using Watch = std::function<void(double, const std::vector<Actor>&)>;

inline double approached(double from, double to, double up, double down) {
  return std::clamp(to, from - (from > 0 ? down : up), from + (from < 0 ? down : up));
}

/// Least distance of the centres of two discs that move straight for a moment.
inline double closestApproach(const mrpt::math::TPoint2D& a0, const mrpt::math::TPoint2D& a1,
                              const mrpt::math::TPoint2D& b0, const mrpt::math::TPoint2D& b1) {
  const auto p = a0 - b0, d = (a1 - a0) - (b1 - b0);
  const double d2 = d.x * d.x + d.y * d.y;
  const double t = d2 > 0 ? std::clamp(-(p.x * d.x + p.y * d.y) / d2, 0.0, 1.0) : 0;
  return (p + d * t).norm();
}

/// All plan on the same instant, then move for a period in steps of 10 ms: ramps as the limits allow, exact arcs; the
/// clearance is that of the whole time. A collision is counted, and the run goes on.
inline EncounterResult runEncounter(Encounter e, const Watch& watch = {}) {
  constexpr int kSteps = 25;
  const double dt = e.period_s / kSteps, R = e.limits.radius_m;
  std::vector<std::unique_ptr<LocalPlanner>> planners;
  for (size_t i = 0; i < e.actors.size(); ++i)
    planners.push_back(e.actors[i].planner == "straight"
                           ? nullptr
                           : makeLocalPlanner(e.actors[i].planner, i == 0 ? e.robot : e.others));
  std::vector<mrpt::math::TTwist2D> orders(e.actors.size());
  std::vector<MovingObstacle> seen;
  PlanOutput out;
  EncounterResult result;
  while (result.time_s < e.patience_s) {
    for (size_t i = 0; i < e.actors.size(); ++i) {
      const auto& me = e.actors[i];
      orders[i] = {e.limits.v_max, 0, 0};
      if (!planners[i]) continue;
      seen.clear();
      for (size_t j = 0; j < e.actors.size(); ++j) {
        const auto& other = e.actors[j];
        const double dx = other.pose.x - me.pose.x, dy = other.pose.y - me.pose.y;
        const double bearing = std::remainder(std::atan2(dy, dx) - me.pose.phi, 2 * M_PI);
        if (i == j || (j == 0 && !me.sees_robot) || std::hypot(dx, dy) > e.sight_m) continue;
        if (std::abs(bearing) > 0.5 * e.field_of_view) continue;
        MovingObstacle o;
        o.id = static_cast<int>(j);
        o.position = {other.pose.x, other.pose.y};
        o.velocity = {other.v * std::cos(other.pose.phi), other.v * std::sin(other.pose.phi)};
        o.radius_m = R;
        seen.push_back(o);
      }
      PlanInput input;
      input.time_s = result.time_s;
      input.pose = me.pose;
      input.twist = {me.v, 0, me.w};
      input.goal = {me.goal.x, me.goal.y, 0};
      input.moving = seen;
      input.limits = e.limits;
      input.period_s = e.period_s;
      planners[i]->plan(input, out);
      orders[i] = out.command;
      if (i == 0 && out.status == PlanOutput::Status::kGoalReached) {
        result.reached = true;
        return result;
      }
    }
    for (int step = 0; step < kSteps; ++step) {
      const auto before = e.actors;
      for (size_t i = 0; i < e.actors.size(); ++i) {
        auto& a = e.actors[i];
        const double v = approached(a.v, orders[i].vx, e.limits.accel * dt, e.limits.brake * dt);
        const double w = approached(a.w, orders[i].omega, e.limits.turn_accel * dt, e.limits.turn_accel * dt);
        const double mean_v = 0.5 * (a.v + v), turn = 0.5 * (a.w + w) * dt, half = 0.5 * turn;
        const double chord = mean_v * dt * (std::abs(half) > 1e-9 ? std::sin(half) / half : 1);
        a.pose.x += chord * std::cos(a.pose.phi + half);
        a.pose.y += chord * std::sin(a.pose.phi + half);
        a.pose.phi = std::remainder(a.pose.phi + turn, 2 * M_PI);
        a.v = v;
        a.w = w;
        if (i == 0) result.way_m += std::abs(mean_v) * dt;
      }
      const auto at = [](const Actor& a) { return mrpt::math::TPoint2D(a.pose.x, a.pose.y); };
      for (size_t j = 1; j < e.actors.size(); ++j)
        result.clearance_m =
            std::min(result.clearance_m,
                     closestApproach(at(before[0]), at(e.actors[0]), at(before[j]), at(e.actors[j])) - 2 * R);
    }
    result.collided = result.clearance_m < 0;
    result.time_s += e.period_s;
    if (watch) watch(result.time_s, e.actors);
  }
  return result;
}

/// Table 4.1; accelerations are not in it: those at which the dissertation's average velocities can be had at all.
inline RobotLimits table41() {
  RobotLimits l;
  l.radius_m = 0.3;
  l.v_max = 1;
  l.v_reverse = 0;
  l.w_max = 0.35;
  l.accel = l.brake = l.turn_accel = 1;
  return l;
}

/// The planners as in the dissertation: DWA takes moving obstacles to stand still.
inline LocalPlannerParams section41() {
  LocalPlannerParams p;
  p.dwa.moving = "still";
  p.dwa.goal.tolerance_m = p.edwa.window.goal.tolerance_m = p.hrvo.goal.tolerance_m = 0.5;
  return p;
}

/// Scenarios 1-4 of section 4.1 with starts shifted by up to `shift_m`; the start places of obstacles, which the text
/// does not give, are such that all would meet at the centre.
/// @param scenario  1 one oncoming; 2 two oncoming; 3 two crossing; 4 two crossing and one oncoming
inline Encounter section41Encounter(int scenario, const std::string& robot, const std::string& others, uint64_t seed,
                                    double shift_m = 0.25) {
  Encounter e;
  e.limits = table41();
  e.robot = e.others = section41();
  const bool sees = others != "dwa" && others != "straight";
  const auto add = [&](const std::string& planner, double x, double y, double gx, double gy) {
    e.actors.push_back({planner, {x, y, std::atan2(gy - y, gx - x)}, {gx, gy}, sees, 0, 0});
  };
  add(robot, 0, -10, 0, 9);
  if (scenario == 1) add(others, 0, 10, 0, -9);
  if (scenario == 2) {
    add(others, -1, 10, -1, -9);
    add(others, 1, 10, 1, -9);
  }
  if (scenario >= 3) {
    add(others, -10, 0, 9, 0);
    add(others, 10, 0, -9, 0);
  }
  if (scenario == 4) add(others, 0, 10, 0, -9);
  Random random(seed, static_cast<uint64_t>(scenario));
  for (auto& a : e.actors) {
    a.pose.x += random.uniform(-shift_m, shift_m);
    a.pose.y += random.uniform(-shift_m, shift_m);
  }
  return e;
}

}  // namespace sidestep::support
