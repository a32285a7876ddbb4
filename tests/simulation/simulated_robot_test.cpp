// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulated_robot.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <cmath>
#include <limits>
#include <map>

#include "core/errors.h"
#include "simulation/world.h"

namespace sidestep {
namespace {

/// Two robots on a plane, with all sensors.
WorldParams twoRobots() {
  WorldParams p;
  p.duration_s = 5;
  p.robot_names = {"first", "second"};
  p.robots["first"].goal_x_m = 50;
  p.robots["second"].y_m = 3, p.robots["second"].goal_x_m = 50;
  p.imu.rate_hz = 50;
  p.gps.rate_hz = 5;
  p.laser.rate_hz = 10, p.laser.beams = 91;
  return p;
}

mrpt::math::TPose2D truthOf(const Reading& r) {
  const auto& pose = dynamic_cast<const mrpt::obs::CObservationRobotPose&>(*r.observation).pose.mean;
  return {pose.x(), pose.y(), pose.yaw()};
}

TEST(SimulatedRobot, GivesTheReadingsOfTheScenariosSensorsOnceAndInOrder) {
  World world(twoRobots(), 1);
  RobotPort& robot = world.robotPort(0);
  for (int i = 0; i < 100; ++i) world.step();
  std::vector<Reading> readings;
  robot.read(readings);
  std::map<std::string, int> counts;
  for (const Reading& r : readings) {
    ++counts[word(r.kind)];
    EXPECT_EQ(word(r.kind), r.label);
  }
  // 1 s: a step of 10 ms each has wheels and truth
  EXPECT_EQ(counts, (std::map<std::string, int>{
                        {"gps", 5}, {"ground_truth", 100}, {"imu", 50}, {"laser", 10}, {"odometry", 100}}));
  for (size_t i = 1; i < readings.size(); ++i) EXPECT_GE(readings[i].time_s, readings[i - 1].time_s);
  EXPECT_NEAR(readings.back().time_s, kSimulationStart_s + 1, 1e-6);
  EXPECT_NEAR(robot.health().last_reading_s, kSimulationStart_s + 1, 1e-6);
  readings.clear();
  robot.read(readings);
  EXPECT_TRUE(readings.empty());
}

TEST(SimulatedRobot, AnyRobotMayBeDrivenAndStopped) {
  World world(twoRobots(), 1);
  RobotPort& robot = world.robotPort(1);
  robot.drive({0.5, 0, 0});
  for (int i = 0; i < 300; ++i) world.step();
  std::vector<Reading> readings;
  robot.read(readings);
  mrpt::math::TPose2D last;
  for (const Reading& r : readings)
    if (r.kind == SensorKind::kGroundTruth) last = truthOf(r);
  EXPECT_NEAR(last.x, 1.25, 1e-6);  // 1 s of ramp, 0.25 m; then 2 s at 0.5 m/s
  EXPECT_NEAR(last.y, 3, 1e-9);
  EXPECT_EQ(world.robots()[0].pose.x, 0);
  robot.stop();
  for (int i = 0; i < 150; ++i) world.step();
  EXPECT_EQ(world.robots()[1].twist.vx, 0);
  EXPECT_TRUE(robot.health().drivable);
  robot.drive({std::numeric_limits<double>::quiet_NaN(), 0, std::numeric_limits<double>::infinity()});
  world.run();
  EXPECT_EQ(world.robots()[1].twist.vx, 0);
  EXPECT_FALSE(robot.health().drivable);
  EXPECT_EQ(robot.health().problem, "the simulated time is over");
}

TEST(SimulatedRobot, TheBaseStopsByItselfWhenNobodyDrives) {
  auto p = twoRobots();
  p.robots["first"].drive.timeout_s = 0.5;
  World world(p, 1);
  world.robotPort(0).drive({1, 0, 0});
  for (int i = 0; i < 300; ++i) world.step();
  EXPECT_EQ(world.robots()[0].twist.vx, 0);
}

TEST(SimulatedRobot, TheRobotUnderTestIsTheOneThatIsNamed) {
  auto p = twoRobots();
  p.under_test = "second";
  World world(p, 1);
  EXPECT_EQ(world.robotUnderTest(), 1u);
  EXPECT_NEAR(world.sensed().truth.pose.y, 3, 1e-9);
  world.command(1, {1, 0, 0});
  world.run();
  EXPECT_NEAR(world.sensed().odometry.pose.x, world.underTest().pose.x, 1e-6);
  EXPECT_GT(summarize(world).path_m, 3);
  p.under_test = "secund";
  try {
    World none(p, 1);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "under_test = secund: is no robot; did you mean 'second'?");
  }
}

}  // namespace
}  // namespace sidestep
