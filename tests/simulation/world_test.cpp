// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include <cmath>
#include <set>

#include "core/errors.h"
#include "evaluation/experiments/world_controllers.h"
#include "simulation/world_observations.h"

namespace sidestep {
namespace {

/// A robot at the origin that goes 10 m along x, at up to 1 m/s.
WorldParams lane() {
  WorldParams p;
  p.robot_names = {"robot"};
  p.robots["robot"].goal_x_m = 10;
  return p;
}

PeopleParams straight(double x, double y, double goal_x, double goal_y, double speed) {
  PeopleParams p;
  p.model = "straight", p.speed = speed;
  p.x_m = x, p.y_m = y, p.goal_x_m = goal_x, p.goal_y_m = goal_y;
  return p;
}

TEST(World, AnEmptyWayIsGoneInTheTimeThatTheLimitsAllow) {
  World world(lane(), 1, {}, navigatorControllers());
  world.run();
  const auto s = summarize(world);
  EXPECT_TRUE(s.success);
  EXPECT_NEAR(s.path_m, 9.7, 0.02);  // within the tolerance of 0.3 m of the goal
  EXPECT_GT(s.time_s, 10.7);         // 2 s of ramp cost 1 s
  EXPECT_LT(s.time_s, 12.5);
  EXPECT_FALSE(std::isfinite(s.min_clearance_m));
}

TEST(World, GoalsAreReachedOneAfterTheOther) {
  auto p = lane();
  p.robots["robot"].goals = {{4, 0}, {4, 3}, {0, 3}};
  World world(p, 1, {}, navigatorControllers());
  std::vector<double> at_goals;
  world.run([&] {
    if (world.robots()[0].goals_reached > static_cast<int>(at_goals.size())) at_goals.push_back(world.time());
    return true;
  });
  const auto s = summarize(world);
  EXPECT_TRUE(s.arrived);
  EXPECT_EQ(s.goals_reached, 3);
  ASSERT_EQ(at_goals.size(), 3u);
  EXPECT_LT(at_goals[0], at_goals[1]);
  EXPECT_DOUBLE_EQ(at_goals[2], s.time_s);
  // 4 + 3 + 4 m, less the tolerance of 0.3 m at each goal
  EXPECT_GT(s.path_m, 9.5);
  EXPECT_LT(s.path_m, 11.5);
  EXPECT_NEAR(world.robots()[0].pose.y, 3, 0.3);

  p.duration_s = at_goals[1] + 0.5;
  World shorter(p, 1, {}, navigatorControllers());
  shorter.run();
  EXPECT_FALSE(summarize(shorter).arrived);
  EXPECT_EQ(summarize(shorter).goals_reached, 2);
}

TEST(World, ClearanceIsExactBetweenSteps) {
  // Two discs pass each other at 0.05 m between their rims, in steps of 0.1 s that never see them side by side.
  SweptDisc a{{0, 0}, {0.4, 0}, 0.3}, b{{0.3, 0.65}, {-0.3, 0.65}, 0.3};
  EXPECT_NEAR(sweptClearance(a, b), 0.05, 1e-12);
  b.from = {5, 0.65}, b.to = {4, 0.65};
  EXPECT_NEAR(sweptClearance(a, b), std::hypot(3.6, 0.65) - 0.6, 1e-12);
}

TEST(World, KnowsWhoHitWhom) {
  // The robot runs into somebody who stands; somebody runs into the robot's side while it stands.
  auto p = lane();
  p.people_names = {"standing"};
  p.people["standing"] = straight(5, 0.1, 5, 0.1, 0);
  World hit(p, 1, {}, navigatorControllers());
  hit.run();
  ASSERT_EQ(hit.contacts(0).contacts().size(), 1u);
  EXPECT_EQ(hit.contacts(0).contacts()[0].kind, Contact::Kind::kRobotIntoPerson);
  EXPECT_NEAR(hit.contacts(0).contacts()[0].closing_speed, 1, 0.02);
  EXPECT_NEAR(hit.contacts(0).minClearance(), 0.1 - 0.6, 1e-4);
  EXPECT_FALSE(summarize(hit).success);

  p.robots["robot"].planner = "stand";
  p.people["standing"] = straight(0, -5, 0, 5, 1.5);
  p.duration_s = 10;
  World struck(p, 1, {}, navigatorControllers());
  struck.run();
  ASSERT_EQ(struck.contacts(0).contacts().size(), 1u);
  EXPECT_EQ(struck.contacts(0).contacts()[0].kind, Contact::Kind::kPersonIntoRobot);
  EXPECT_NEAR(struck.contacts(0).contacts()[0].time_s, 4.4 / 1.5, 0.011);
}

TEST(World, AWallHoldsTheRobot) {
  auto p = lane();
  p.duration_s = 20;
  p.wall_names = {"across"};
  p.walls["across"] = {{{5, -3}, {5, 3}}, false};
  World world(p, 1, {}, navigatorControllers());
  world.run();
  EXPECT_FALSE(summarize(world).arrived);
  EXPECT_EQ(summarize(world).contacts.at("robot_into_wall"), 1);
  EXPECT_LE(world.robots()[0].pose.x, 4.7);
  EXPECT_GT(world.robots()[0].pose.x, 4.65);
}

TEST(World, RobotsMeetAndOneMayBeBlindToTheFirst) {
  auto p = lane();
  p.robot_names = {"robot", "other"};
  p.robots["other"].x_m = 10, p.robots["other"].yaw = M_PI;
  p.robots["other"].sees_robot = false;
  World world(p, 1, {}, navigatorControllers());
  world.step();
  EXPECT_EQ(world.perceived(0).size(), 0u) << "10 m away, beyond the range of 8 m";
  world.run();
  EXPECT_EQ(summarize(world).contacts.at("robot_into_robot"), 1);
  p.robots["other"].x_m = 5;
  World near(p, 1, {}, navigatorControllers());
  near.step();
  EXPECT_EQ(near.perceived(0).size(), 1u);
  EXPECT_EQ(near.perceived(1).size(), 0u);
}

/// Runs in 20 that end in a contact, with a robot that goes straight on at 0.8 m/s.
int contactsOf(PeopleParams somebody, double robot_room_m) {
  int out = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    auto p = lane();
    p.duration_s = 20;
    p.social_force.robot_room_m = robot_room_m;
    p.robots["robot"].goal_x_m = 15;
    p.robots["robot"].limits.v_max = p.robots["robot"].start_speed = 0.8;
    somebody.start_spread_m = 0.3;
    p.people_names = {"somebody"};
    p.people["somebody"] = somebody;
    World world(p, seed, {}, navigatorControllers());
    world.run();
    out += summarize(world).collision;
  }
  return out;
}

TEST(World, PeopleWhoSeeARobotThatDoesNotYieldDoNotTouchIt) {
  const double room_m = SocialForceParams().robot_room_m;
  PeopleParams against, crossing, behind;
  against.x_m = 12, against.goal_x_m = -10;
  crossing.x_m = crossing.goal_x_m = 6, crossing.y_m = -1.34 * 6 / 0.8, crossing.goal_y_m = 20;
  behind.x_m = -6, behind.goal_x_m = 30;
  for (const auto& somebody : {against, crossing, behind}) {
    EXPECT_EQ(contactsOf(somebody, room_m), 0);
    EXPECT_GT(contactsOf(somebody, 0), 8) << "as printed, points among points, they do";
    PeopleParams blind = somebody;
    blind.sees_robots = false;
    EXPECT_GT(contactsOf(blind, room_m), 8);
  }
}

TEST(World, PerceptionEndsAtRangeFieldAndWhatHides) {
  auto p = lane();
  p.robots["robot"].planner = "stand";
  const std::pair<const char*, PeopleParams> all[] = {
      {"ahead", straight(3, 0, 3, 0, 0)},    {"hidden", straight(6, 0, 6, 0, 0)},
      {"half", straight(6, 0.6, 6, 0.6, 0)}, {"far", straight(8.1, 3, 8.1, 3, 0)},
      {"behind", straight(-3, 0, -3, 0, 0)}, {"aside", straight(-1, 1.1, -1, 1.1, 0)},
      {"walled", straight(0, -4, 0, -4, 0)}};
  for (const auto& [name, person] : all) {
    p.people_names.push_back(name);
    p.people[name] = person;
  }
  p.wall_names = {"screen"};
  p.walls["screen"] = {{{-2, -2}, {2, -2}}, false};
  World world(p, 1, {}, navigatorControllers());
  world.step();
  std::set<int> seen;
  for (const auto& o : world.perceived(0)) seen.insert(o.id);
  EXPECT_EQ(seen, (std::set<int>{0, 2, 5}));  // ahead, half hidden, at 132 degrees
  p.robots["robot"].perception.occlusion = false;
  World glass(p, 1, {}, navigatorControllers());
  glass.step();
  EXPECT_EQ(glass.perceived(0).size(), 5u);
}

WorldParams busy() {
  auto p = lane();
  p.people_names = {"crowd"};
  p.people["crowd"].count = 15;
  p.people["crowd"].x_m = 5, p.people["crowd"].start_spread_m = 5, p.people["crowd"].goal_spread_m = 10;
  p.laser.rate_hz = 10, p.laser.beams = 181;
  p.encoders.tick_m = 0.001;
  p.imu.rate_hz = 50;
  p.gps.rate_hz = 5;
  return p;
}

std::vector<double> traceOf(const WorldParams& p, uint64_t seed) {
  World world(p, seed, {}, navigatorControllers());
  std::vector<double> out;
  world.run([&] {
    for (const auto& person : world.people()) out.push_back(person.position.x);
    out.push_back(world.sensed().odometry.pose.x);
    if (world.sensed().gps) out.push_back(world.sensed().gps->y);
    if (world.scan() != nullptr) out.insert(out.end(), world.scan()->ranges().begin(), world.scan()->ranges().end());
    return world.time() < 5;
  });
  return out;
}

TEST(World, TheSameSeedIsTheSameWorld) {
  const auto a = traceOf(busy(), 3);
  EXPECT_EQ(a, traceOf(busy(), 3));
  EXPECT_NE(a, traceOf(busy(), 4));
}

TEST(World, CommandsFromOutsideMoveARobotWithoutController) {
  World world(lane(), 1);
  for (int i = 0; i < 300; ++i) {
    if (i % 5 == 0) world.command(0, {0.5, 0, 0});
    world.step();
  }
  EXPECT_NEAR(world.robots()[0].pose.x, 1.25, 1e-6);  // 1 s of ramp, 0.25 m; then 2 s at 0.5 m/s
}

TEST(World, OdometryFollowsTheWheelsNotTheGround) {
  auto p = lane();
  p.robots["robot"].drive.slip_mean = 0.1;
  World world(p, 1, {}, navigatorControllers());
  world.run();
  EXPECT_NEAR(world.robots()[0].pose.x / world.sensed().odometry.pose.x, 0.9, 1e-6);
}

TEST(World, ReportsWhatTheLogNeeds) {
  World world(busy(), 1, {}, navigatorControllers());
  WorldReporter reporter(world);
  std::map<std::string, int> counts;
  const auto sink = [&](const mrpt::obs::CObservation& o) {
    ++counts[o.sensorLabel];
    if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&o)) {
      EXPECT_EQ(scan->getScanSize(), 181u);
      EXPECT_TRUE(scan->rightToLeft);
    }
    const auto* daq = dynamic_cast<const mrpt::obs::CObservationRawDAQ*>(&o);
    if (daq != nullptr && o.sensorLabel == "people") {
      ASSERT_EQ(daq->AIN_double.size(), 15u * 9);
      EXPECT_EQ(daq->AIN_double[9], 1);  // the second person's id
      EXPECT_EQ(daq->AIN_double[10], world.people()[1].position.x);
    }
  };
  reporter.tell(sink);
  for (int i = 0; i < 200; ++i) {
    world.step();
    reporter.tell(sink);
  }
  EXPECT_EQ(counts, (std::map<std::string, int>{{"command", 40},
                                                {"gps", 10},
                                                {"ground_truth", 201},
                                                {"imu", 100},
                                                {"laser", 20},
                                                {"odometry", 201},
                                                {"people", 20}}));
}

std::string errorOf(const WorldParams& p) {
  try {
    World world(p, 1, {}, navigatorControllers());
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(World, WhatCannotBeIsRefusedByName) {
  EXPECT_EQ(errorOf({}), "robots: there is none; name at least one");
  auto p = lane();
  p.control_period_s = 0.055;
  EXPECT_EQ(errorOf(p), "control_period_s = 0.055 s: is no whole number of step_s = 0.01 s");
  p = lane();
  p.robots["robot"].planner = "strait";
  EXPECT_NE(errorOf(p).find("no local planner 'strait'"), std::string::npos) << errorOf(p);
  EXPECT_NE(errorOf(p).find("did you mean 'straight'?"), std::string::npos) << errorOf(p);
  p = lane();
  p.wall_names = {"w"};
  p.walls["w"].points = {{0, 0}};
  EXPECT_EQ(errorOf(p), "walls.w.points: has fewer than two corners");
}

}  // namespace
}  // namespace sidestep
