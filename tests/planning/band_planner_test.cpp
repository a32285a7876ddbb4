// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band_planner.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/errors.h"
#include "support/allocations.h"
#include "support/band_scenes.h"

namespace sidestep {
namespace {

using Status = PlanOutput::Status;
using support::BandScene;

PlanOutput planOnce(const BandPlannerParams& params, const PlanInput& input) {
  BandPlanner planner(params);
  PlanOutput out;
  planner.plan(input, out);
  return out;
}

TEST(BandPlanner, EveryNameIsAPlannerAndAnotherOneIsRefused) {
  for (const auto& name : bandPlannerNames()) EXPECT_NO_THROW(bandPlannerParams(name)) << name;
  try {
    bandPlannerParams("tebb");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "no band planner 'tebb'; did you mean 'teb'?");
  }
}

TEST(BandPlanner, AMirroredWorldMirrorsTheCommand) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    BandScene scene(seed, 4, 3), mirrored(seed, 4, 3);
    mirrored.mirror();
    const auto a = planOnce(bandPlannerParams("eteb"), scene.input()),
               b = planOnce(bandPlannerParams("eteb"), mirrored.input());
    EXPECT_NEAR(a.command.vx, b.command.vx, 1e-6) << seed;
    EXPECT_NEAR(a.command.omega, -b.command.omega, 1e-6) << seed;
  }
}

TEST(BandPlanner, AnyNumberOfThreadsGivesTheSameBytes) {
  const ParallelFor together = [](int n, const std::function<void(int)>& f) {
    std::vector<std::thread> threads;
    for (int k = n - 1; k >= 0; --k) threads.emplace_back([&f, k] { f(k); });
    for (auto& t : threads) t.join();
  };
  BandPlanner one(bandPlannerParams("eteb")), many(bandPlannerParams("eteb"));
  many.useThreads(together);
  PlanOutput a, b;
  BandScene scene(3, 10, 5);
  for (int k = 0; k < 20; ++k) {
    one.plan(scene.input(), a);
    many.plan(scene.input(), b);
    ASSERT_EQ(a.command.vx, b.command.vx) << k;
    ASSERT_EQ(a.command.omega, b.command.omega) << k;
    scene.advance(a.command);
  }
}

TEST(BandPlanner, AllocatesNothingOnceItHasSeenTheScene) {
  BandPlanner planner(bandPlannerParams("pteb+eteb"));
  PlanOutput out;
  long allocations = 0;
  for (bool count : {false, true}) {
    BandScene scene(4, 20, 6);
    planner.reset();
    for (int k = 0; k < 30; ++k) {
      const PlanInput input = scene.input();
      const long before = testing::allocationsSoFar();
      planner.plan(input, out);
      if (count) allocations += testing::allocationsSoFar() - before;
      scene.advance(out.command);
    }
  }
  EXPECT_EQ(allocations, 0);
}

TEST(BandPlanner, AWallThatAppearsTooCloseIsBrakedForAndNamed) {
  PlanInput in;
  in.goal = {8, 0, 0};
  in.twist = {1, 0, 0};
  BandPlanner planner(bandPlannerParams("teb"));
  PlanOutput out;
  planner.plan(in, out);
  EXPECT_EQ(out.status, Status::kMoving);
  const std::vector<Segment> wall = {{{0.6, -6}, {0.6, 6}}};
  in.time_s = 0.1;
  in.walls = wall;
  planner.plan(in, out);
  EXPECT_EQ(out.status, Status::kBraking);
  EXPECT_NEAR(out.command.vx, 0.95, 1e-9);  // 0.5 m/s^2 for 0.1 s
  EXPECT_NE(out.reason.find("contact with something static in "), std::string::npos) << out.reason;
}

TEST(BandPlanner, InputThatIsNotFiniteIsBrakedFor) {
  PlanInput in;
  in.goal = {8, 0, 0};
  in.twist = {0.5, 0, 0};
  in.pose.x = std::numeric_limits<double>::quiet_NaN();
  const auto out = planOnce(bandPlannerParams("teb"), in);
  EXPECT_EQ(out.status, Status::kBraking);
  EXPECT_EQ(out.reason, "pose, twist, goal or time is not finite");
  EXPECT_NEAR(out.command.vx, 0.45, 1e-9);
}

TEST(BandPlanner, AtTheGoalItStops) {
  PlanInput in;
  in.goal = {0.05, 0, 0};
  const auto out = planOnce(bandPlannerParams("teb"), in);
  EXPECT_EQ(out.status, Status::kGoalReached);
  EXPECT_EQ(out.command.vx, 0);
}

TEST(BandPlanner, WithoutTimeItStillAnswersWithACheckedBand) {
  BandScene scene(5, 10, 0);
  PlanInput in = scene.input();
  in.out_of_time = [] { return true; };
  const auto out = planOnce(bandPlannerParams("teb"), in);
  EXPECT_NE(out.status, Status::kGoalReached);
  EXPECT_TRUE(std::isfinite(out.command.vx));
}

TEST(BandPlanner, PtebPaysEachCandidateItsOwnAngle) {
  BandScene scene(6, 6, 4);
  BandPlanner planner(bandPlannerParams("pteb"));
  planner.explain(true);
  PlanOutput out;
  for (int k = 0; k < 5; ++k) {
    planner.plan(scene.input(), out);
    scene.advance(out.command);
  }
  ASSERT_GE(out.candidates.size(), 2u);
  std::set<double> headings;
  for (const auto& c : out.candidates)
    for (const auto& [term, cost] : c.costs)
      if (term == "hrvo_heading") headings.insert(cost);
  EXPECT_GE(headings.size(), 2u);
}

TEST(BandPlanner, EightHundredObstaclesLeaveAWay) {
  BandScene scene(8, 800, 0);
  const auto out = planOnce(bandPlannerParams("teb"), scene.input());
  EXPECT_EQ(out.status, Status::kMoving) << out.reason;
}

TEST(BandPlanner, CommandsAreFiniteAndInsideTheLimitsWhateverComes) {
  int braked = 0;
  for (uint64_t seed = 1; seed <= 300; ++seed) {
    const std::string wrong = support::fuzzBandPlanner(seed, braked);
    EXPECT_EQ(wrong, "") << "seed " << seed;
  }
  EXPECT_GT(braked, 0);
}

}  // namespace
}  // namespace sidestep
