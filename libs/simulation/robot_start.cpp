// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/robot_start.h"

#include <cmath>
#include <limits>

#include "core/errors.h"
#include "core/geometry.h"
#include "simulation/contacts.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr int kTries = 10000;

/// Whether nobody is near, or will be soon.
bool isFree(const TPoint2D& at, const RobotParams& p, std::span<const Person> people) {
  const SweptDisc self{at, at, p.limits.radius_m};
  for (const Person& other : people) {
    if (!other.present) continue;
    const SweptDisc body{other.position, other.position + other.velocity * p.route.clear_s, other.radius_m};
    if (sweptClearance(self, body) < p.route.clear_m) return false;
  }
  return true;
}

bool isClear(const TPoint2D& at, const RobotParams& p, const WallIndex& walls, std::vector<uint32_t>& near) {
  const double reach = p.limits.radius_m + p.route.clear_m;
  walls.near(at, reach, near);
  for (const uint32_t k : near)
    if ((nearestPoint(walls.walls()[k], at) - at).norm() < reach) return false;
  return true;
}

RobotStart drawRoute(const RobotParams& p, Random& random, std::span<const Person> people, const WallIndex& walls) {
  const RouteParams& r = p.route;
  std::vector<uint32_t> near;
  for (int i = 0; i < kTries; ++i) {
    const double x = random.uniform(r.x_low_m, r.x_high_m), y = random.uniform(r.y_low_m, r.y_high_m);
    const double yaw = random.uniform(-M_PI, M_PI);
    const TPoint2D start(x, y), goal(x + r.length_m * std::cos(yaw), y + r.length_m * std::sin(yaw));
    const bool inside = goal.x >= r.x_low_m && goal.x <= r.x_high_m && goal.y >= r.y_low_m && goal.y <= r.y_high_m;
    if (inside && isFree(start, p, people) && isClear(start, p, walls, near) && isClear(goal, p, walls, near))
      return {{x, y, yaw}, goal};
  }
  throw ConfigError("route: no start and goal found " + shortestNumber(r.length_m) +
                    " m apart that are clear of everything; widen the rectangle, or lower length_m or clear_m");
}

}  // namespace

RobotStart drawStart(const RobotParams& p, Random random, std::span<const Person> people, const WallIndex& walls) {
  if (p.route.length_m > 0) return drawRoute(p, random, people, walls);
  const double dx = p.start_shift_m * random.uniform(-1, 1), dy = p.start_shift_m * random.uniform(-1, 1);
  const double turn = p.start_turn > 0 ? p.start_turn * random.uniform(-1, 1) : 0;
  return {{p.x_m + dx, p.y_m + dy, p.yaw + turn}, {p.goal_x_m, p.goal_y_m}};
}

}  // namespace sidestep
