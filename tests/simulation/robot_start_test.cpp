// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/robot_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "simulation/world.h"

namespace sidestep {
namespace {

RobotParams routed() {
  RobotParams p;
  p.limits.radius_m = 0.3;
  p.route.length_m = 6;
  p.route.x_low_m = -4, p.route.x_high_m = 4, p.route.y_low_m = -1, p.route.y_high_m = 5;
  return p;
}

Person personAt(double x, double y, double vx) {
  Person p;
  p.position = {x, y};
  p.velocity = {vx, 0};
  return p;
}

TEST(RobotStart, ARouteLiesWithinItsRectangleAndFacesItsGoal) {
  const RobotParams p = routed();
  double least = 10, most = -10;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const RobotStart s = drawStart(p, Random(seed), {}, WallIndex(std::vector<Segment>{}));
    for (const double x : {s.pose.x, s.goal.x}) EXPECT_TRUE(x >= -4 && x <= 4) << x;
    for (const double y : {s.pose.y, s.goal.y}) EXPECT_TRUE(y >= -1 && y <= 5) << y;
    EXPECT_NEAR(s.goal.x - s.pose.x, 6 * std::cos(s.pose.phi), 1e-12);
    EXPECT_NEAR(s.goal.y - s.pose.y, 6 * std::sin(s.pose.phi), 1e-12);
    least = std::min(least, s.pose.x), most = std::max(most, s.pose.x);
  }
  EXPECT_LT(least, -3);
  EXPECT_GT(most, 3);
}

TEST(RobotStart, NobodyIsNearOrSoonWillBe) {
  const RobotParams p = routed();  // clear_m 0.5, clear_s 2
  const Person one = personAt(0, 2, 1);
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    const RobotStart s = drawStart(p, Random(seed), {&one, 1}, WallIndex(std::vector<Segment>{}));
    const double nearest_x = std::clamp(s.pose.x, 0.0, 2.0);  // it walks from x = 0 to 2
    EXPECT_GE(std::hypot(s.pose.x - nearest_x, s.pose.y - 2), 0.3 + one.radius_m + 0.5 - 1e-9);
  }
}

TEST(RobotStart, NoPlaceIsAnErrorThatSaysWhatToDo) {
  std::vector<Segment> walls;
  for (double y = -1; y <= 5; y += 0.5) walls.push_back({{-5, y}, {5, y}});
  try {
    drawStart(routed(), Random(1), {}, WallIndex(walls));
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("widen the rectangle, or lower length_m or clear_m"), std::string::npos);
  }
  WorldParams p;
  p.robot_names = {"robot"};
  p.robots["robot"] = routed();
  p.robots["robot"].route.length_m = 20;
  EXPECT_THROW(p.check(), ConfigError);
}

TEST(RobotStart, AStartMayBeTurnedAtRandomWithoutMovingIt) {
  RobotParams p;
  p.start_shift_m = 0.5;
  const RobotStart as_given = drawStart(p, Random(3, 1), {}, {});
  p.start_turn = 0.4;
  double least = 1, most = -1;
  for (uint64_t seed = 1; seed <= 100; ++seed) {
    const double yaw = drawStart(p, Random(seed, 1), {}, {}).pose.phi;
    least = std::min(least, yaw), most = std::max(most, yaw);
  }
  EXPECT_TRUE(least >= -0.4 && least < -0.3) << least;
  EXPECT_TRUE(most <= 0.4 && most > 0.3) << most;
  EXPECT_EQ(drawStart(p, Random(3, 1), {}, {}).pose.x, as_given.pose.x);
  EXPECT_EQ(as_given.pose.phi, 0);
}

TEST(World, RecordedPeopleAreMetAtATimeThatTheSeedSays) {
  WorldParams p;
  p.robot_names = {"robot"};
  p.robots["robot"].planner = "stand";
  p.tracks_shift_s = 50;
  WorldInputs inputs;
  inputs.tracks = {{1, {{0, {0, 9}}, {100, {100, 9}}}}};  // x is the recording's time
  double least = 100, most = 0;
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const World a(p, seed, inputs), b(p, seed, inputs);
    const double x = a.people()[0].position.x;
    EXPECT_EQ(x, b.people()[0].position.x);
    EXPECT_TRUE(x >= 0 && x <= 50) << x;
    least = std::min(least, x), most = std::max(most, x);
  }
  EXPECT_LT(least, 10);
  EXPECT_GT(most, 40);
}

}  // namespace
}  // namespace sidestep
