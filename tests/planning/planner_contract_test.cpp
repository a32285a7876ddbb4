// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What every local planner of the table promises.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <new>

#include "core/errors.h"
#include "planning/planners.h"
#include "planning/velocity/hrvo_planner.h"
#include "planning/window/window_planner.h"
#include "support/allocations.h"
#include "support/planning_worlds.h"

namespace sidestep::testing {
namespace {

using support::crowdedWorld;
using support::openWorld;
using support::person;
using support::PlanningWorld;

const double kNan = std::numeric_limits<double>::quiet_NaN();

/// Those of this test; planners of other kinds have other habits of memory.
const std::vector<std::string> kNames = {"dwa", "hrvo", "edwa"};

void expectInsideLimits(const PlanInput& in, const PlanOutput& out, const std::string& what) {
  ASSERT_TRUE(std::isfinite(out.command.vx) && std::isfinite(out.command.omega)) << what;
  const auto& l = in.limits;
  EXPECT_LE(out.command.vx, l.v_max + 1e-9) << what;
  EXPECT_GE(out.command.vx, -l.v_reverse - 1e-9) << what;
  EXPECT_LE(std::abs(out.command.omega), l.w_max + 1e-9) << what;
  EXPECT_LE(out.command.vx - in.twist.vx, l.accel * in.period_s + 1e-9) << what;
  EXPECT_GE(out.command.vx - in.twist.vx, -l.brake * in.period_s - 1e-9) << what;
  EXPECT_LE(std::abs(out.command.omega - in.twist.omega), l.turn_accel * in.period_s + 1e-9) << what;
}

TEST(LocalPlanners, AreMadeByNameAndAMisspeltNameIsAnError) {
  for (const auto& name : localPlannerNames()) EXPECT_NE(makeLocalPlanner(name), nullptr) << name;
  try {
    makeLocalPlanner("edwaa");
    FAIL() << "made";
  } catch (const ConfigError& e) {
    const std::string line = e.what();
    EXPECT_NE(line.find("no local planner 'edwaa'"), std::string::npos) << line;
    EXPECT_NE(line.find("did you mean 'edwa'?"), std::string::npos) << line;
  }
}

TEST(LocalPlanners, CommandsAreInsideTheLimitsAndReachable) {
  Random random(1);
  for (const auto& name : kNames) {
    const auto planner = makeLocalPlanner(name);
    PlanOutput out;
    for (int i = 0; i < 300; ++i) {
      auto world = crowdedWorld(random, 12);
      planner->plan(world.shown(), out);
      expectInsideLimits(world.input, out, name + " world " + std::to_string(i));
    }
  }
}

TEST(LocalPlanners, WheelSpeedsStayBelowTheirLimit) {
  Random random(2);
  for (const auto& name : kNames) {
    const auto planner = makeLocalPlanner(name);
    PlanOutput out;
    for (int i = 0; i < 100; ++i) {
      auto world = crowdedWorld(random, 5);
      world.input.limits.wheel_speed_max = 1;
      world.input.twist = {0.5, 0, 0};
      planner->plan(world.shown(), out);
      EXPECT_LE(out.command.vx + 0.5 * world.input.limits.track_m * std::abs(out.command.omega), 1 + 1e-9) << name;
    }
  }
}

TEST(LocalPlanners, DriveStraightToTheGoalWhereNothingIs) {
  for (const auto& name : kNames) {
    auto world = openWorld(0.8);
    PlanOutput out;
    makeLocalPlanner(name)->plan(world.shown(), out);
    EXPECT_EQ(out.status, PlanOutput::Status::kMoving) << name;
    EXPECT_NEAR(out.command.vx, 1, 1e-9) << name;  // 0.8 + 1 m/s^2 * 0.25 s, at most 1
    EXPECT_NEAR(out.command.omega, 0, 1e-9) << name;
    EXPECT_EQ(out.reason, "") << name;
  }
}

TEST(LocalPlanners, WhatMovesAwayCostsNothing) {
  // A person ahead who is faster, one behind who is slower, one who crosses long before: the same command as alone.
  for (const auto& name : kNames) {
    auto alone = openWorld(1), world = openWorld(1);
    world.moving = {person(2, 0, 1.2, 0), person(-2, 0, 0.5, 0), person(3, 1.2, 0, 1)};
    PlanOutput a, b;
    makeLocalPlanner(name)->plan(alone.shown(), a);
    makeLocalPlanner(name)->plan(world.shown(), b);
    EXPECT_NEAR(a.command.vx, b.command.vx, 1e-9) << name;
    EXPECT_NEAR(a.command.omega, b.command.omega, 1e-9) << name;
  }
}

TEST(LocalPlanners, StopAtTheGoalAndTurnToItsHeadingWhereThatMatters) {
  for (const auto& name : kNames) {
    auto world = openWorld(0.1);
    world.input.goal = {0.05, 0.05, 1};
    PlanOutput out;
    const auto planner = makeLocalPlanner(name);
    planner->plan(world.shown(), out);
    EXPECT_EQ(out.status, PlanOutput::Status::kGoalReached) << name;
    EXPECT_EQ(out.command.vx, 0) << name;
    world.input.goal_heading_matters = true;
    planner->plan(world.shown(), out);
    EXPECT_EQ(out.status, PlanOutput::Status::kMoving) << name;
    EXPECT_NEAR(out.command.omega, 0.25, 1e-9) << name;  // as fast as turn_accel 1 rad/s^2 allows in 0.25 s
    EXPECT_EQ(out.command.vx, 0) << name;
  }
}

TEST(LocalPlanners, BrakeAndSayWhyWhenInputIsNotFinite) {
  const auto spoil = [](int i) {
    auto w = openWorld(0.8);
    w.moving = {person(3, 0, 0, 0)};
    w.walls = {{{5, -1}, {5, 1}}};
    w.points = {{6, 1}};
    if (i == 0) w.input.pose.x = kNan;
    if (i == 1) w.input.goal.y = kNan;
    if (i == 2) w.moving[0].velocity.x = kNan;
    if (i == 3) w.walls[0].a.x = kNan;
    if (i == 4) w.points[0].y = kNan;
    if (i == 5) w.input.twist.vx = kNan;
    if (i == 6) w.input.period_s = 0;
    return w;
  };
  for (const auto& name : kNames)
    for (int i = 0; i < 7; ++i) {
      auto world = spoil(i);
      PlanOutput out;
      makeLocalPlanner(name)->plan(world.shown(), out);
      EXPECT_EQ(out.status, PlanOutput::Status::kBraking) << name << i;
      EXPECT_NE(out.reason, "") << name << i;
      ASSERT_TRUE(std::isfinite(out.command.vx)) << name << i;
      if (i < 5) {
        EXPECT_NEAR(out.command.vx, 0.55, 1e-9) << name << i;
      }
    }
}

TEST(LocalPlanners, StayFiniteWhereObstaclesOverlapTheRobotOrEachOther) {
  for (const auto& name : kNames) {
    auto world = openWorld(0.5);
    world.moving = {person(0, 0, 0, 0), person(0, 0, 1, 0), person(0.2, 0.1, -1, 0), person(0.2, 0.1, -1, 0)};
    world.walls = {{{0, 0}, {0, 0}}, {{-1, 0}, {1, 0}}};
    world.points = {{0, 0}, {0.1, 0}};
    PlanOutput out;
    makeLocalPlanner(name)->plan(world.shown(), out);
    expectInsideLimits(world.input, out, name);
  }
}

TEST(LocalPlanners, MirroredWorldsGetMirroredCommands) {
  Random random(4);
  LocalPlannerParams params;
  params.of<EdwaParams>().hrvo.keep_right = params.of<HrvoPlannerParams>().hrvo.keep_right =
      0;  // a rule of the road has no mirror image
  for (const auto& name : kNames) {
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
      auto world = crowdedWorld(random, 6);
      auto mirror = support::mirrored(world);
      PlanOutput a, b;
      makeLocalPlanner(name, params)->plan(world.shown(), a);
      makeLocalPlanner(name, params)->plan(mirror.shown(), b);
      if (a.status != PlanOutput::Status::kMoving) continue;
      EXPECT_NEAR(a.command.vx, b.command.vx, 1e-6) << name << " world " << i;
      EXPECT_NEAR(a.command.omega, -b.command.omega, 1e-6) << name << " world " << i;
      ++compared;
    }
    EXPECT_GT(compared, 50) << name;
  }
}

TEST(LocalPlanners, RepeatThemselvesAndExplainingChangesNothing) {
  Random random(5);
  for (const auto& name : kNames) {
    const auto one = makeLocalPlanner(name), two = makeLocalPlanner(name);
    two->explain(true);
    PlanOutput a, b;
    for (int i = 0; i < 50; ++i) {
      auto world = crowdedWorld(random, 8);
      one->plan(world.shown(), a);
      two->plan(world.shown(), b);
      ASSERT_EQ(a.command.vx, b.command.vx) << name;
      ASSERT_EQ(a.command.omega, b.command.omega) << name;
      EXPECT_TRUE(a.candidates.empty());
      if (a.status == PlanOutput::Status::kGoalReached) continue;
      ASSERT_FALSE(b.candidates.empty()) << name;
      int chosen = 0;
      for (const auto& c : b.candidates) {
        chosen += c.rejected.empty();
        double sum = 0;
        for (const auto& [term, cost] : c.costs) sum += cost;
        EXPECT_NEAR(sum, c.total, 1e-9) << name;
      }
      EXPECT_EQ(chosen, 1) << name;
    }
  }
}

TEST(LocalPlanners, AllocateNothingAfterTheFirstCycles) {
  for (const auto& name : kNames) {
    Random random(6);
    const auto planner = makeLocalPlanner(name);
    PlanOutput out;
    std::vector<PlanningWorld> worlds;
    for (int i = 0; i < 30; ++i) worlds.push_back(crowdedWorld(random, 50));
    for (auto& w : worlds) w.points = {{3, 0}, {3, 0.1}};
    for (auto& w : worlds) w.walls = {{{4, -3}, {4, 3}}, {{-4, -3}, {-4, 3}}};
    for (auto& w : worlds) planner->plan(w.shown(), out);
    const long before = allocationsSoFar();
    for (int round = 0; round < 3; ++round)
      for (auto& w : worlds) planner->plan(w.shown(), out);
    EXPECT_EQ(allocationsSoFar() - before, 0) << name;
  }
}

}  // namespace
}  // namespace sidestep::testing
