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

/// Plans with time for so many questions after it. @return how often it asked
int planWithPatience(int patience, const PlanInput& input, BandPlanner& planner, PlanOutput& out) {
  int asked = 0;
  PlanInput in = input;
  in.out_of_time = [&] { return ++asked > patience; };
  planner.plan(in, out);
  return asked;
}

TEST(BandPlanner, WhenTimeIsOverTheBestCheckedBandSoFarLeaves) {
  for (const char* name : {"teb", "eteb"})
    for (uint64_t seed = 1; seed <= 10; ++seed)
      for (int patience : {0, 3, 20}) {
        BandScene scene(seed, 10, 3);
        BandPlanner planner(bandPlannerParams(name));
        PlanOutput out;
        const int asked = planWithPatience(patience, scene.input(), planner, out);
        EXPECT_LE(asked, patience + 40) << "each loop asks once and ends";
        ASSERT_EQ(out.status, Status::kMoving) << name << seed << out.reason;
        const BandExtremes most = extremesOf(planner.chosen()->band, planner.chosen()->ends);
        EXPECT_LE(most.v, 1.01);
        EXPECT_LE(most.a, 0.505) << name << seed << " " << patience;
        EXPECT_LE(most.turn_accel, 0.505) << name << seed << " " << patience;
      }
}

TEST(BandPlanner, WithMoreTimeTheBandCostsNoMore) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    double before = 1e9;
    for (int patience : {0, 10, 1000}) {
      BandScene scene(seed, 10, 0);
      BandPlannerParams params = bandPlannerParams("teb");
      params.exploration.classes_max = 1;
      BandPlanner planner(params);
      PlanOutput out;
      planWithPatience(patience, scene.input(), planner, out);
      ASSERT_NE(planner.chosen(), nullptr);
      EXPECT_LE(planner.chosen()->result.cost, before + 1e-9) << seed << " " << patience;
      before = planner.chosen()->result.cost;
    }
  }
}

TEST(BandPlanner, TurningToAndFroIsNamedAsOscillation) {
  // somebody moves the goal from one side to the other every half second
  PlanInput in;
  BandPlanner planner(bandPlannerParams("teb"));
  PlanOutput out;
  int named = 0;
  for (int k = 0; k < 60; ++k) {
    in.goal = {8, k / 5 % 2 == 0 ? 6.0 : -6.0, 0};
    in.time_s = 0.1 * k;
    in.limits.turn_accel = 3;
    planner.plan(in, out);
    in.twist = out.command;
    in.pose.phi += out.command.omega * in.period_s;
    named += out.reason.starts_with("oscillation: ") ? 1 : 0;
  }
  EXPECT_GT(named, 0);
}

TEST(BandPlanner, ABandThatIsNotFiniteIsNamedAsDiverged) {
  BandOptimizer optimizer({}, {});
  Band band = {{0, 0, 0, 0}, {1, std::numeric_limits<double>::quiet_NaN(), 0, 1}, {2, 0, 0, 2}, {3, 0, 0, 3}};
  EXPECT_TRUE(optimizer.optimize({}, false, {}, band).diverged);
}

TEST(BandPlanner, CandidatesSayWhatWasComparedAndWhyTheyLost) {
  BandScene scene(3, 12, 0);
  BandPlanner planner(bandPlannerParams("teb"));
  planner.explain(true);
  PlanOutput out;
  planner.plan(scene.input(), out);
  ASSERT_GE(out.candidates.size(), 2u);
  int chosen = 0;
  for (const auto& c : out.candidates) {
    double sum = 0;
    for (const auto& [term, cost] : c.costs) sum += cost;
    EXPECT_NEAR(sum, c.total, 1e-9 * (1 + c.total));
    chosen += c.rejected.empty() ? 1 : 0;
  }
  EXPECT_EQ(chosen, 1);
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
  support::FuzzCount count;
  for (uint64_t seed = 1; seed <= 500; ++seed) {
    const std::string wrong = support::fuzzBandPlanner(seed, count);
    EXPECT_EQ(wrong, "") << "seed " << seed;
  }
  EXPECT_GT(count.braked, 0);
  EXPECT_GT(count.reached, 0);
}

}  // namespace
}  // namespace sidestep
