// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/random.h"
#include "planning/band/band_planner.h"

namespace sidestep::support {

/// Random points and walkers between (0, 0) and (8, 0), and a robot that drives what it is told.
class BandScene {
 public:
  BandScene(uint64_t seed, int points, int movers) {
    Random random(seed);
    for (int i = 0; i < points; ++i) points_.push_back({random.uniform(1, 7), random.uniform(-3, 3)});
    for (int i = 0; i < movers; ++i) {
      MovingObstacle o;
      o.id = i;
      o.position = {random.uniform(1.5, 7), random.uniform(-3, 3)};
      o.velocity = {random.uniform(-0.8, 0.8), random.uniform(-0.8, 0.8)};
      moving_.push_back(o);
    }
    in_.goal = {8, 0, 0};
  }
  PlanInput input() {
    in_.points = points_;
    in_.moving = moving_;
    return in_;
  }
  void mirror() {
    for (auto& p : points_) p.y = -p.y;
    for (auto& o : moving_) {
      o.position.y = -o.position.y;
      o.velocity.y = -o.velocity.y;
    }
  }
  void advance(const mrpt::math::TTwist2D& command) {
    const double heading = in_.pose.phi + command.omega * in_.period_s / 2;
    in_.pose.x += command.vx * in_.period_s * std::cos(heading);
    in_.pose.y += command.vx * in_.period_s * std::sin(heading);
    in_.pose.phi += command.omega * in_.period_s;
    in_.twist = command;
    in_.time_s += in_.period_s;
    for (auto& o : moving_) o.position = o.position + o.velocity * in_.period_s;
  }

 private:
  PlanInput in_;
  std::vector<mrpt::math::TPoint2D> points_;
  std::vector<MovingObstacle> moving_;
};

/// What is wrong with a command, "" if nothing.
inline std::string complaint(const PlanOutput& out, const PlanInput& in) {
  const auto& l = in.limits;
  const auto& c = out.command;
  constexpr double kRound = 1e-9;
  if (!std::isfinite(c.vx) || !std::isfinite(c.vy) || !std::isfinite(c.omega)) return "command is not finite";
  if (c.vy != 0) return "sideways";
  if (c.vx > l.v_max || c.vx < -l.v_reverse || std::abs(c.omega) > l.w_max) return "beyond a speed limit";
  if (std::abs(c.vx) + std::abs(c.omega) * l.track_m / 2 > l.wheel_speed_max) return "beyond the wheels' limit";
  const bool known = std::isfinite(in.twist.vx) && std::isfinite(in.twist.omega) && l.wheel_speed_max > 100;
  if (known && std::abs(c.vx - in.twist.vx) > std::max(l.accel, l.brake) * in.period_s + kRound) return "acceleration";
  if (known && std::abs(c.omega - in.twist.omega) > l.turn_accel * in.period_s + kRound) return "turn acceleration";
  for (const auto& p : out.trajectory)
    if (!std::isfinite(p.after_s + p.pose.x + p.pose.y + p.pose.phi + p.v + p.w)) return "trajectory is not finite";
  return "";
}

/// One random problem, with a few plans in a row: obstacles on the robot, the goal in an obstacle, at the robot, behind
/// it, 0 to 800 obstacles, numbers that are not finite. @return what went wrong, "" if nothing
inline std::string fuzzBandPlanner(uint64_t seed, int& braked) {
  Random random(seed);
  const auto& names = bandPlannerNames();
  BandPlannerParams params = bandPlannerParams(names[random.below(names.size())]);
  params.exploration.classes_max = 1 + static_cast<int>(random.below(4));
  BandPlanner planner(params);
  PlanInput in;
  in.pose = {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-4, 4)};
  in.twist = {random.uniform(-in.limits.v_reverse, in.limits.v_max), 0, random.uniform(-1, 1) * in.limits.w_max};
  if (random.below(5) == 0) in.limits.wheel_speed_max = random.uniform(0.2, 1.5);
  const uint64_t where = random.below(6);
  in.goal = {in.pose.x + random.uniform(-9, 9), in.pose.y + random.uniform(-9, 9), random.uniform(-4, 4)};
  if (where == 0) in.goal = in.pose;
  if (where == 1) in.goal.x = in.pose.x - 3 * std::cos(in.pose.phi), in.goal.y = in.pose.y - 3 * std::sin(in.pose.phi);
  in.goal_heading_matters = random.below(3) == 0;
  constexpr int kCounts[] = {0, 0, 1, 3, 10, 30, 100, 800};
  const uint64_t count = random.below(200);  // 800 rarely: they take most of the time
  const int n = count == 0 ? 800 : kCounts[random.below(7)];
  std::vector<mrpt::math::TPoint2D> points;
  std::vector<MovingObstacle> moving;
  std::vector<Segment> walls;
  for (int i = 0; i < n; ++i) {
    const mrpt::math::TPoint2D p(in.pose.x + random.uniform(-6, 6), in.pose.y + random.uniform(-6, 6));
    if (random.below(2) == 0) {
      points.push_back(p);
      continue;
    }
    MovingObstacle o;
    o.id = i;
    o.position = p;
    o.velocity = {random.uniform(-2, 2), random.uniform(-2, 2)};
    o.radius_m = random.uniform(0, 0.6);
    o.covariance = Eigen::Matrix2d::Identity() * random.uniform();
    moving.push_back(o);
  }
  if (random.below(4) == 0) points.push_back({in.pose.x, in.pose.y});
  if (random.below(4) == 0) points.push_back({in.goal.x, in.goal.y});
  if (random.below(4) == 0) walls.push_back({{in.pose.x + 1, in.pose.y - 2}, {in.pose.x + 1, in.pose.y + 2}});
  if (random.below(8) == 0) walls.push_back({{in.pose.x, in.pose.y}, {in.pose.x, in.pose.y}});
  const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300};
  if (random.below(20) == 0) points.push_back({bad[random.below(3)], 0});
  if (random.below(20) == 0 && !moving.empty()) moving[0].velocity.x = bad[random.below(3)];
  if (random.below(40) == 0) in.pose.x = bad[random.below(3)];
  std::vector<mrpt::math::TPose2D> path;
  if (random.below(5) == 0)
    for (int i = 0; i <= 20; ++i)
      path.push_back({in.pose.x + (in.goal.x - in.pose.x) * i / 20, in.pose.y + std::sin(i * 0.5), 0});
  in.points = points;
  in.walls = walls;
  in.moving = moving;
  in.path = path;
  PlanOutput out;
  for (int k = 0; k < 4; ++k) {
    planner.plan(in, out);
    if (const std::string wrong = complaint(out, in); !wrong.empty()) return wrong;
    braked += out.status == PlanOutput::Status::kBraking ? 1 : 0;
    in.pose.x += out.command.vx * in.period_s * std::cos(in.pose.phi);
    in.pose.y += out.command.vx * in.period_s * std::sin(in.pose.phi);
    in.pose.phi += out.command.omega * in.period_s;
    in.twist = out.command;
    in.time_s += in.period_s;
  }
  return "";
}

}  // namespace sidestep::support
