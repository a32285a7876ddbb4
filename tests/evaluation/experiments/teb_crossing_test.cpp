// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Figures 4.13 and 4.18 of the dissertation.
#include <gtest/gtest.h>

#include "evaluation/experiments/plan_snapshots.h"
#include "evaluation/experiments/world_controllers.h"

namespace sidestep {
namespace {

WorldScenario crossing(const std::string& planner) {
  WorldScenario scenario;
  std::string kind;
  readYaml(std::string(SIDESTEP_SOURCE) + "/share/scenarios/teb-crossing.yaml", [&](ParamVisitor& v) {
    v.choice("kind", kind, {"world"}, "");
    scenario.visit(v);
  });
  scenario.world.robots.at(scenario.world.robot_names[0]).planner = planner;
  return scenario;
}

int contactsIn(const std::string& planner, int seeds) {
  const WorldScenario scenario = crossing(planner);
  int out = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    World world(scenario.world, static_cast<uint64_t>(seed), {}, navigatorControllers(scenario.planners));
    world.run();
    out += summarize(world).collision ? 1 : 0;
  }
  return out;
}

TEST(TebCrossing, ProactivePlannersLetPeoplePassWhereTebRunsIntoThem) {
  EXPECT_GE(contactsIn("teb", 10), 4);  // 78 of 100 in the study
  EXPECT_LE(contactsIn("pteb", 10), 2);
  EXPECT_EQ(contactsIn("eteb", 10), 0);
}

TEST(TebCrossing, SnapshotsHoldAllCandidatesAndAreOfTheSameRun) {
  const auto snapshots = takeSnapshots(crossing("teb"), 1, {}, {1, 3});
  ASSERT_EQ(snapshots.size(), 2u);
  EXPECT_NEAR(snapshots[0].time_s, 1, 1e-9);
  EXPECT_EQ(snapshots[0].others.size(), 2u);
  int chosen = 0;
  for (const auto& line : snapshots[0].candidates) chosen += line.chosen ? 1 : 0;
  EXPECT_EQ(chosen, 1);
  EXPECT_GE(snapshots[0].candidates.size(), 2u);
  // whoever is looked at drives as if nobody looked
  const WorldScenario scenario = crossing("teb");
  World world(scenario.world, 1, {}, navigatorControllers(scenario.planners));
  while (world.time() < 3 - 1e-9) world.step();
  EXPECT_DOUBLE_EQ(world.robots()[0].pose.x, snapshots[1].robot.x);
  EXPECT_DOUBLE_EQ(world.robots()[0].pose.y, snapshots[1].robot.y);
}

}  // namespace
}  // namespace sidestep
