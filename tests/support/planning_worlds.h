// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <vector>

#include "core/random.h"
#include "planning/local_planner.h"

namespace sidestep::support {

/// What a planner is shown, with the memory that `PlanInput` only points to.
struct PlanningWorld {
  std::vector<MovingObstacle> moving;
  std::vector<Segment> walls;
  std::vector<mrpt::math::TPoint2D> points;
  PlanInput input;

  const PlanInput& shown() {
    input.moving = moving;
    input.walls = walls;
    input.points = points;
    return input;
  }
};

inline MovingObstacle person(double x, double y, double vx, double vy, double radius_m = 0.3) {
  MovingObstacle m;
  m.position = {x, y};
  m.velocity = {vx, vy};
  m.radius_m = radius_m;
  return m;
}

/// A robot at the origin that drives along x at `v` to a goal 10 m ahead.
inline PlanningWorld openWorld(double v = 0.8) {
  PlanningWorld w;
  w.input.twist = {v, 0, 0};
  w.input.goal = {10, 0, 0};
  w.input.period_s = 0.25;
  w.input.limits.accel = w.input.limits.brake = w.input.limits.turn_accel = 1;
  w.input.limits.w_max = 1;
  w.input.limits.v_reverse = 0;
  return w;
}

/// People all around, none nearer than 0.8 m, at up to 1.2 m/s; the robot somewhere, at some speed and turn rate.
inline PlanningWorld crowdedWorld(Random& random, int people, double reach_m = 5) {
  PlanningWorld w = openWorld(random.uniform(0, 1));
  w.input.pose = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
  w.input.twist.omega = random.uniform(-1, 1);
  w.input.goal = {random.uniform(-9, 9), random.uniform(-9, 9), 0};
  while (static_cast<int>(w.moving.size()) < people) {
    const double x = random.uniform(-reach_m, reach_m), y = random.uniform(-reach_m, reach_m);
    if (std::hypot(x, y) < 0.8) continue;
    w.moving.push_back(
        person(w.input.pose.x + x, w.input.pose.y + y, random.uniform(-0.85, 0.85), random.uniform(-0.85, 0.85)));
  }
  return w;
}

/// The same world in a mirror along the map's x axis.
inline PlanningWorld mirrored(PlanningWorld w) {
  w.input.pose.y = -w.input.pose.y;
  w.input.pose.phi = -w.input.pose.phi;
  w.input.twist.omega = -w.input.twist.omega;
  w.input.goal.y = -w.input.goal.y;
  for (auto& m : w.moving) {
    m.position.y = -m.position.y;
    m.velocity.y = -m.velocity.y;
  }
  for (auto& s : w.walls) s = {{s.a.x, -s.a.y}, {s.b.x, -s.b.y}};
  for (auto& p : w.points) p.y = -p.y;
  return w;
}

}  // namespace sidestep::support
