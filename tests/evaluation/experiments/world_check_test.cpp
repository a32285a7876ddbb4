// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/world_check.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "evaluation/experiments/scenario.h"
#include "evaluation/experiments/standing_reasons.h"
#include "evaluation/experiments/world_scenario.h"

namespace sidestep {
namespace {

/// A room with a robot and anna in it, in which nothing is wrong.
WorldScenario room() { return Scenario::exampleOf("world").world; }

std::string problemsOf(const WorldScenario& s) { return describe(findProblems(s.world, {}), "w.yaml", ""); }

TEST(WorldCheck, FindsNothingInAWorldThatIsInOrder) { EXPECT_EQ(problemsOf(room()), ""); }

TEST(WorldCheck, TellsWhoStartsInAWallOrOnSomebody) {
  auto s = room();
  s.world.robots["robot"].x_m = 0.1;
  EXPECT_NE(problemsOf(s).find("robots.robot.x_m: robot robot starts at (0.10, 2.50), 0.10 m from a wall"),
            std::string::npos)
      << problemsOf(s);
  s = room();
  s.world.people["anna"].x_m = 1.2, s.world.people["anna"].y_m = 2.5;
  EXPECT_NE(problemsOf(s).find("people.anna.x_m: anna starts at (1.20, 2.50) and overlaps robot robot"),
            std::string::npos)
      << problemsOf(s);
  s = room();
  s.world.people["anna"].count = 3;
  EXPECT_NE(problemsOf(s).find("people.anna.count: 3 people start at one place"), std::string::npos) << problemsOf(s);
}

TEST(WorldCheck, TellsGoalsToWhichNoWayLeads) {
  auto s = room();
  s.world.robots["robot"].goal_x_m = 9;
  EXPECT_NE(problemsOf(s).find("robots.robot.goal_x_m: the goal at (9.00, 2.50) cannot be reached"), std::string::npos)
      << problemsOf(s);
  s = room();
  s.world.people["anna"].goal_y_m = 7;
  EXPECT_NE(problemsOf(s).find("people.anna.goal_x_m: the goal at (2.00, 7.00) cannot be reached"), std::string::npos);
  // a door of 0.7 m is wide enough for a robot of 0.6 m, one of 0.5 m is not
  for (const double half : {0.35, 0.25}) {
    s = room();
    s.world.wall_names.insert(s.world.wall_names.end(), {"low", "high"});
    s.world.walls["low"].points = {{4, 0}, {4, 2.5 - half}};
    s.world.walls["high"].points = {{4, 2.5 + half}, {4, 5}};
    EXPECT_EQ(problemsOf(s).empty(), half > 0.3) << problemsOf(s);
  }
}

TEST(WorldCheck, ADescriptionHasTheLineOfTheKeyOrOfItsGroup) {
  const std::string yaml = "kind: world\nrobots:\n  robot:\n    goal_x_m: 3\n";
  EXPECT_EQ(describe({{"robots.robot.goal_x_m", "a"}, {"robots.robot.x_m", "b"}, {"people.anna", "c"}}, "w.yaml", yaml),
            "w.yaml:4: robots.robot.goal_x_m: a\nw.yaml:3: robots.robot.x_m: b\nw.yaml: people.anna: c");
}

std::string errorOfSet(const std::string& set) {
  auto s = room();
  try {
    s.layOver(set, "study.yaml");
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(WorldCheck, AMisspeltNameInASetIsNobodyNew) {
  EXPECT_EQ(errorOfSet("\n\npeople: {ana: {speed: 0.5}}\n"),
            "study.yaml:3: people.ana: the scenario has no such name; did you mean 'anna'?");
  EXPECT_EQ(errorOfSet("robots: {car: {planner: dwa}}\n"),
            "study.yaml:1: robots.car: the scenario has no such name, it has robot; a new one must say x_m");
  EXPECT_EQ(errorOfSet("people: {anna: {speed: 0.5}, bob: {x_m: 3}}\n"), "");
}

TEST(StandingReasons, CountsWhyTheRobotStoodAndTakesNumbersForOne) {
  StandingReasons standing;
  PlanInput in;
  PlanOutput out;
  out.reason = "waits 1.5 s for a gap";
  standing.note(in, out);
  out.reason = "waits 20 s for a gap";
  standing.note(in, out);
  out.reason = "";
  standing.note(in, out);
  in.twist.vx = 0.5;
  standing.note(in, out);
  EXPECT_DOUBLE_EQ(standing.share(), 0.75);
  const auto reasons = standing.reasons();
  ASSERT_EQ(reasons.size(), 2u);
  EXPECT_EQ(reasons[0].first, "waits # s for a gap");
  EXPECT_DOUBLE_EQ(reasons[0].second, 0.5);
  EXPECT_EQ(reasons[1].first, "no reason given");
}

}  // namespace
}  // namespace sidestep
