// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/planner_driver.h"

#include <gtest/gtest.h>

#include "core/errors.h"
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

TEST(PlannerDriver, ALocalPlannerDrivesWithWhatIsPerceived) {
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
    return makePlannerDriver(std::make_unique<Shy>(), limits);
  });
  world.run();
  // It sees the person from 3 m off, at x = 3, and brakes from 0.7 m/s at 0.5 m/s^2: 0.49 m, plus up to one period.
  EXPECT_GT(world.robots()[0].pose.x, 3.48);
  EXPECT_LT(world.robots()[0].pose.x, 3.49 + 0.7 * 0.06);
  EXPECT_FALSE(summarize(world).collision);
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
  World world(p, 1, {}, plannerDrivers({}));
  world.run();
  EXPECT_TRUE(world.robots()[0].arrived) << planner;
  return world.time();
}

TEST(PlannerDriver, ABaseThatIsBehindItsOrdersIsDrivenAboutAsFast) {
  // Orders that are bounded by how the base moves now would let it speed up by a fraction of what it can only: each
  // period it is asked for a bit more than it has, and gives a part of that.
  for (const std::string planner : {"dwa", "edwa", "hrvo"}) {
    const double prompt = timeFor12m(planner, 0, 0);
    EXPECT_LT(timeFor12m(planner, 0.15, 0), prompt + 0.6) << planner;
    EXPECT_LT(timeFor12m(planner, 0, 0.1), prompt + 0.6) << planner;
    EXPECT_LT(timeFor12m(planner, 0.15, 0.1), prompt + 0.8) << planner;
  }
}

TEST(PlannerDriver, OtherNamesAreTheSimpleDriversOrErrors) {
  const auto factory = plannerDrivers({});
  EXPECT_NE(factory("stand", {}), nullptr);
  for (const auto& name : localPlannerNames()) EXPECT_NE(factory(name, {}), nullptr);
  EXPECT_THROW(factory("nobody", {}), ConfigError);
}

}  // namespace
}  // namespace sidestep
