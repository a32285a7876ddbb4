// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/random.h"
#include "maps/distance_field.h"
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

/// What became of the plans of random problems.
struct FuzzCount {
  int plans = 0, braked = 0, reached = 0, diverged = 0;
};

/// A random problem: obstacles on the robot, the goal in an obstacle, at the robot, behind it, 0 to 800 obstacles (most
/// have few), walls, a distance field, numbers that are not finite, a global path, a robot longer than wide, little
/// time.
class FuzzProblem {
 public:
  explicit FuzzProblem(uint64_t seed) : random_(seed) {
    robot();
    goal();
    obstacles();
    onTopOfEachOther();
    notFinite();
    globalPath();
  }
  BandPlannerParams params() {
    const auto& names = bandPlannerNames();
    BandPlannerParams params = bandPlannerParams(names[random_.below(names.size())]);
    params.exploration.classes_max = 1 + static_cast<int>(random_.below(4));
    if (oneIn(8)) params.footprint = {random_.uniform(0.3, 1.5), random_.uniform(0.3, 0.8), random_.uniform(-0.3, 0.3)};
    return params;
  }
  /// Plans a few times while the robot drives what it is told. @return what went wrong, "" if nothing
  std::string run(BandPlanner& planner, FuzzCount& count) {
    int asked = 0;
    const int patience = oneIn(10) ? static_cast<int>(random_.below(20)) : 1 << 30;
    if (patience < 1 << 30) in_.out_of_time = [&] { return ++asked > patience; };
    planner.explain(true);
    PlanOutput out;
    for (int k = 0; k < kPlans; ++k) {
      asked = 0;
      planner.plan(shown(), out);
      ++count.plans;
      if (const std::string wrong = complaint(out, in_); !wrong.empty()) return wrong;
      for (const auto& c : out.candidates)
        if (c.rejected == "diverged") {
          ++count.diverged;
          if (finite_) return "a band diverged";
        }
      count.braked += out.status == PlanOutput::Status::kBraking ? 1 : 0;
      count.reached += out.status == PlanOutput::Status::kGoalReached ? 1 : 0;
      advance(out.command);
    }
    return "";
  }

 private:
  static constexpr int kPlans = 3;
  bool oneIn(uint64_t n) { return random_.below(n) == 0; }

  void robot() {
    in_.pose = {random_.uniform(-5, 5), random_.uniform(-5, 5), random_.uniform(-4, 4)};
    auto& l = in_.limits;
    if (oneIn(4)) l.v_max = random_.uniform(0.2, 3), l.v_reverse = oneIn(2) ? 0 : random_.uniform(0, l.v_max);
    if (oneIn(4)) l.accel = random_.uniform(0.1, 3), l.brake = random_.uniform(0.1, 3);
    if (oneIn(4)) l.w_max = random_.uniform(0.2, 4), l.turn_accel = random_.uniform(0.1, 4);
    in_.twist = {random_.uniform(-l.v_reverse, l.v_max), 0, random_.uniform(-1, 1) * l.w_max};
    if (oneIn(5)) l.wheel_speed_max = random_.uniform(0.2, 1.5);
  }
  void goal() {
    const auto& p = in_.pose;
    in_.goal = {p.x + random_.uniform(-9, 9), p.y + random_.uniform(-9, 9), random_.uniform(-4, 4)};
    const uint64_t where = random_.below(6);
    if (where == 0) in_.goal = p;
    if (where == 1) in_.goal.x = p.x - 3 * std::cos(p.phi), in_.goal.y = p.y - 3 * std::sin(p.phi);
    in_.goal_heading_matters = oneIn(3);
  }
  int howMany() {
    const double share = random_.uniform();
    if (share < 0.0015) return 800;
    if (share < 0.02) return 100;
    const double most = share < 0.2 ? 0 : share < 0.7 ? 6 : share < 0.93 ? 20 : 60;
    return static_cast<int>(random_.uniform(0, most + 1));
  }
  void obstacles() {
    const int n = howMany();
    for (int i = 0; i < n; ++i) {
      const mrpt::math::TPoint2D p(in_.pose.x + random_.uniform(-6, 6), in_.pose.y + random_.uniform(-6, 6));
      if (oneIn(2)) {
        points_.push_back(p);
        continue;
      }
      MovingObstacle o;
      o.id = i;
      o.position = p;
      o.velocity = {random_.uniform(-2, 2), random_.uniform(-2, 2)};
      o.radius_m = random_.uniform(0, 0.6);
      o.covariance = Eigen::Matrix2d::Identity() * random_.uniform();
      moving_.push_back(o);
    }
    if (oneIn(8)) in_.field = &roomField();
  }
  /// Blocks of 0.2 m to 1 m in 20 m x 20 m, the same for all problems.
  static const DistanceField& roomField() {
    static const DistanceField field = [] {
      GridFrame frame;
      frame.width = frame.height = 200;
      frame.resolution_m = 0.1;
      frame.T_map_grid = {-10, -10, 0};
      std::vector<uint8_t> blocked(200 * 200);
      Random random(1);
      for (int block = 0; block < 25; ++block) {
        const auto x = random.below(190), y = random.below(190), side = 2 + random.below(8);
        for (size_t i = 0; i < side * side; ++i) blocked[(y + i / side) * 200 + x + i % side] = 1;
      }
      return DistanceField(frame, blocked);
    }();
    return field;
  }
  void onTopOfEachOther() {
    const auto& p = in_.pose;
    if (oneIn(4)) points_.push_back({p.x, p.y});
    if (oneIn(4)) points_.push_back({in_.goal.x, in_.goal.y});
    if (oneIn(4)) walls_.push_back({{p.x + 1, p.y - 2}, {p.x + 1, p.y + 2}});
    if (oneIn(8)) walls_.push_back({{p.x, p.y}, {p.x, p.y}});
  }
  void notFinite() {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300};
    const auto spoil = [&](double& value) {
      value = bad[random_.below(3)];
      finite_ = false;
    };
    if (oneIn(20)) points_.push_back({}), spoil(points_.back().x);
    if (oneIn(20) && !moving_.empty()) spoil(moving_[0].velocity.x);
    if (oneIn(40)) spoil(in_.pose.x);
  }
  void globalPath() {
    if (!oneIn(5)) return;
    for (int i = 0; i <= 20; ++i)
      path_.push_back({in_.pose.x + (in_.goal.x - in_.pose.x) * i / 20, in_.pose.y + std::sin(i * 0.5), 0});
  }
  const PlanInput& shown() {
    in_.points = points_;
    in_.walls = walls_;
    in_.moving = moving_;
    in_.path = path_;
    return in_;
  }
  void advance(const mrpt::math::TTwist2D& command) {
    in_.pose.x += command.vx * in_.period_s * std::cos(in_.pose.phi);
    in_.pose.y += command.vx * in_.period_s * std::sin(in_.pose.phi);
    in_.pose.phi += command.omega * in_.period_s;
    in_.twist = command;
    in_.time_s += in_.period_s;
  }

  Random random_;
  PlanInput in_;
  bool finite_ = true;
  std::vector<mrpt::math::TPoint2D> points_;
  std::vector<MovingObstacle> moving_;
  std::vector<Segment> walls_;
  std::vector<mrpt::math::TPose2D> path_;
};

/// @return what went wrong with the problem of a seed, "" if nothing
inline std::string fuzzBandPlanner(uint64_t seed, FuzzCount& count) {
  FuzzProblem problem(seed);
  BandPlanner planner(problem.params());
  return problem.run(planner, count);
}

}  // namespace sidestep::support
