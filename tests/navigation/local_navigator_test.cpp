// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "navigation/local_navigator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "core/geometry.h"
#include "evaluation/experiments/world_controllers.h"
#include "simulation/world.h"

namespace sidestep {
namespace {

/// Goes straight on, and stops for whatever it is told of.
class Shy final : public LocalPlanner {
 public:
  void plan(const PlanInput& input, PlanOutput& out) override {
    EXPECT_DOUBLE_EQ(input.limits.v_max, 0.7);
    EXPECT_DOUBLE_EQ(input.period_s, 0.05);
    out.command = {input.moving.empty() ? input.limits.v_max : 0, 0, 0};
  }
  void reset() override {}
};

TEST(LocalNavigator, ALocalPlannerDrivesWithWhatIsPerceived) {
  WorldParams p;
  p.robot_names = {"robot"};
  RobotParams& robot = p.robots["robot"];
  robot.planner = "shy";
  robot.goal_x_m = 20;
  robot.limits.v_max = 0.7;
  robot.perception.range_m = 3;
  p.people_names = {"one"};
  PeopleParams& one = p.people["one"];
  one.model = "straight", one.speed = 0, one.x_m = one.goal_x_m = 6;
  World world(p, 1, {}, [](const std::string&, const RobotLimits& limits) {
    return makeNavigatorController(std::make_unique<Shy>(), limits);
  });
  world.run();
  // It sees the person from 3 m off, at x = 3, and brakes from 0.7 m/s at 0.5 m/s^2: 0.49 m, plus up to one period.
  EXPECT_GT(world.robots()[0].pose.x, 3.48);
  EXPECT_LT(world.robots()[0].pose.x, 3.49 + 0.7 * 0.06);
  EXPECT_FALSE(summarize(world).collision);
}

/// Keeps what it was told last, and stands.
struct Told {
  std::vector<mrpt::math::TPose2D> path;
  std::vector<MovingObstacle> moving;
};
class Listener final : public LocalPlanner {
 public:
  explicit Listener(Told& told) : told_(told) {}
  void plan(const PlanInput& input, PlanOutput& out) override {
    told_.path.assign(input.path.begin(), input.path.end());
    told_.moving.assign(input.moving.begin(), input.moving.end());
    out.command = {};
  }
  void reset() override {}

 private:
  Told& told_;
};

Situation situationAt(double time_s, const mrpt::math::TPose2D& pose, std::span<const Segment> walls,
                      std::span<const MovingObstacle> moving) {
  Situation now;
  now.time_s = time_s, now.pose = pose, now.goal = {10, 0, 0};
  now.walls = walls, now.moving = moving, now.period_s = 0.1;
  return now;
}

TEST(LocalNavigator, TheFilterFindsVelocitiesAndPredictsWithDoubt) {
  Told told;
  LocalNavigatorParams params;
  params.tracking.filter = "constant_velocity";
  LocalNavigator navigator(std::make_unique<Listener>(told), {}, params);
  MovingObstacle walker;
  walker.id = 3;
  for (int k = 0; k < 30; ++k) {
    walker.position = {5, 0.1 * k};  // 1 m/s to the left; what is said of the velocity is not believed
    walker.velocity = {-7, 0};
    navigator.command(situationAt(0.1 * k, {}, {}, {&walker, 1}));
  }
  ASSERT_EQ(told.moving.size(), 1u);
  EXPECT_NEAR(told.moving[0].velocity.x, 0, 0.02);
  EXPECT_NEAR(told.moving[0].velocity.y, 1, 0.02);
  ASSERT_GT(told.moving[0].predicted.size(), 4u);
  EXPECT_GT(told.moving[0].predicted[4].covariance(0, 0), told.moving[0].predicted[0].covariance(0, 0));
  // not seen for half a second it is still there, farther on
  navigator.command(situationAt(3.4, {}, {}, {}));
  ASSERT_EQ(told.moving.size(), 1u);
  EXPECT_NEAR(told.moving[0].position.y, 3.4, 0.05);
}

double clearanceOf(const std::vector<mrpt::math::TPose2D>& path, const mrpt::math::TPoint2D& p) {
  double out = 1e9;
  for (const auto& q : path) out = std::min(out, std::hypot(q.x - p.x, q.y - p.y));
  return out;
}

TEST(LocalNavigator, ARouteLeadsAroundWallsAndThoseWhoStandAndIsPlannedAnewForAnotherGoal) {
  Told told;
  LocalNavigatorParams params;
  params.path.planner = "astar";
  LocalNavigator navigator(std::make_unique<Listener>(told), {}, params);
  // a room with a wall across the straight way, open above y = 2
  const std::vector<Segment> walls = {
      {{-2, -5}, {12, -5}}, {{12, -5}, {12, 5}}, {{12, 5}, {-2, 5}}, {{-2, 5}, {-2, -5}}, {{5, -5}, {5, 2}}};
  navigator.command(situationAt(0, {}, walls, {}));
  ASSERT_GT(told.path.size(), 10u);
  EXPECT_NEAR(told.path.back().x, 10, 1e-9);
  // the wall's end is at (5, 2): 0.3 m of robot, 0.3 m of room; points are 0.5 m apart, and the map's cells 0.1 m
  EXPECT_GT(clearanceOf(told.path, {5, 2}), 0.5);
  double highest = -1e9;
  for (const auto& p : told.path) highest = std::max(highest, p.y);
  EXPECT_GT(highest, 2.4);
  EXPECT_LT(highest, 3.5);

  // somebody stands in that way, seen for three seconds; the robot stands too, and after its patience looks for another
  MovingObstacle standing;
  standing.position = {5, 2.7};
  for (int k = 1; k <= 60; ++k) navigator.command(situationAt(0.1 * k, {}, walls, {&standing, 1}));
  EXPECT_GT(clearanceOf(told.path, standing.position), 0.75);

  Situation other = situationAt(6.1, {}, walls, {});
  other.goal = {0, 4, 0};
  navigator.command(other);
  EXPECT_NEAR(told.path.back().y, 4, 1e-9);
  EXPECT_LT(told.path.size(), 12u);
}

std::vector<mrpt::math::TPose2D> routeThrough(const std::vector<Segment>& walls, const mrpt::math::TPose2D& goal,
                                              double radius_m = 0.3) {
  GlobalRouteParams params;
  params.planner = "astar";
  Situation now;
  now.goal = goal;
  now.walls = walls;
  return GlobalRoute(params, radius_m).at(now);
}

double lengthOf(const std::vector<mrpt::math::TPose2D>& path) {
  double out = 0;
  for (size_t i = 1; i < path.size(); ++i) out += std::hypot(path[i].x - path[i - 1].x, path[i].y - path[i - 1].y);
  return out;
}

TEST(GlobalRoute, StaysInACorridorThatIsNarrowButWideEnough) {
  for (const double half : {0.35, 0.4, 0.5, 0.6}) {
    const auto path = routeThrough({{{-1, half}, {9, half}}, {{-1, -half}, {9, -half}}}, {8, 0, 0});
    ASSERT_FALSE(path.empty()) << half;
    EXPECT_LT(lengthOf(path), 8.2) << half;
    for (const auto& p : path) EXPECT_LT(std::abs(p.y), half - 0.3) << half;
  }
  // 0.58 m wide, for a robot of 0.6 m, and closed behind it: no way at all
  EXPECT_TRUE(
      routeThrough({{{9, 0.29}, {-1, 0.29}}, {{-1, 0.29}, {-1, -0.29}}, {{-1, -0.29}, {9, -0.29}}}, {8, 0, 0}).empty());
}

TEST(GlobalRoute, AGoalBesideAWallIsJoinedFromItsOwnSide) {
  // a wall along y = 0.5 from x = -10 to 10; the goal lies 0.1 m above it, less than the robot's radius
  const std::vector<Segment> walls = {{{-10, 0.5}, {10, 0.5}}};
  const auto path = routeThrough(walls, {3, 0.6, 0});
  ASSERT_FALSE(path.empty());
  EXPECT_GT(lengthOf(path), 17) << "around an end of the wall, 10 m there and 7 m back";
  for (size_t i = 1; i < path.size(); ++i)
    EXPECT_FALSE(intersect({{path[i - 1].x, path[i - 1].y}, {path[i].x, path[i].y}}, walls[0])) << i;
  EXPECT_NEAR(path.back().x, 3, 1e-9);
  EXPECT_NEAR(path.back().y, 0.6, 1e-9);
}

TEST(GlobalRoute, ATightDoorCostsNoRoomElsewhere) {
  // two rooms, a door of 0.8 m; the corner of a block is on the way to it
  const std::vector<Segment> walls = {{{-2, -4}, {10, -4}}, {{10, -4}, {10, 4}}, {{10, 4}, {-2, 4}},
                                      {{-2, 4}, {-2, -4}},  {{4, 0.4}, {4, 4}},  {{4, -0.4}, {4, -4}},
                                      {{2, -4}, {2, -0.2}}};
  const auto path = routeThrough(walls, {8, 0, 0});
  ASSERT_FALSE(path.empty());
  EXPECT_GT(clearanceOf(path, {2, -0.2}), 0.5) << "0.3 m of robot and room beside it";
  EXPECT_LT(lengthOf(path), 9);
}

TEST(LocalNavigator, WithoutWallsThereIsNoPath) {
  Told told;
  LocalNavigatorParams params;
  params.path.planner = "astar";
  LocalNavigator(std::make_unique<Listener>(told), {}, params).command(situationAt(0, {}, {}, {}));
  EXPECT_TRUE(told.path.empty());
}

/// A robot goes 12 m on an empty plane; how long it takes.
double timeFor12m(const std::string& planner, double lag_s, double latency_s) {
  WorldParams p;
  p.robot_names = {"robot"};
  RobotParams& robot = p.robots["robot"];
  robot.planner = planner;
  robot.goal_x_m = 12;
  robot.drive.lag_s = lag_s;
  robot.drive.latency_s = latency_s;
  World world(p, 1, {}, navigatorControllers());
  world.run();
  EXPECT_TRUE(world.robots()[0].arrived) << planner;
  return world.time();
}

TEST(LocalNavigator, ABaseThatIsBehindItsOrdersIsDrivenAboutAsFast) {
  // Orders that are bounded by how the base moves now would let it speed up by a fraction of what it can only: each
  // period it is asked for a bit more than it has, and gives a part of that.
  for (const std::string planner : {"dwa", "edwa", "hrvo"}) {
    const double prompt = timeFor12m(planner, 0, 0);
    EXPECT_LT(timeFor12m(planner, 0.15, 0), prompt + 0.6) << planner;
    EXPECT_LT(timeFor12m(planner, 0, 0.1), prompt + 0.6) << planner;
    EXPECT_LT(timeFor12m(planner, 0.15, 0.1), prompt + 0.8) << planner;
  }
}

TEST(LocalNavigator, AreMadeForEveryNameOfTheTableAndNoOther) {
  const auto factory = navigatorControllers();
  for (const auto& name : localPlannerNames()) EXPECT_NE(factory(name, {}), nullptr);
  EXPECT_THROW(factory("nobody", {}), ConfigError);
}

}  // namespace
}  // namespace sidestep
