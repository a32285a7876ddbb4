// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/sampling_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "planning/global/global_planners.h"
#include "planning/global/path_smoother.h"
#include "support/grid_worlds.h"

namespace sidestep::testing {
namespace {

using mrpt::math::TPose2D;

/// Two rooms, a door of 1.6 m between them.
std::shared_ptr<const PlanningGrid> rooms() {
  std::vector<std::string> lines(60, std::string(80, '.'));
  for (size_t row = 0; row < 60; ++row)
    if (row < 38 || row > 54) lines[row][40] = '#';
  return std::make_shared<const PlanningGrid>(drawn(lines, 0.1).field(), 0.3);
}

const TPose2D kStart(1, 5, 0), kGoal(7, 5, 1);

/// Looks at the clock, not seconds, end each search.
SamplingParams counted(const std::string& space) {
  SamplingParams params;
  params.space = space;
  params.time_s = 3600;
  params.iterations = 1500;
  return params;
}

void expectAPath(const GlobalPath& path, const DistanceField& field, const std::string& what) {
  ASSERT_TRUE(path.found()) << what << ": " << path.reason;
  EXPECT_NEAR(path.poses.front().x, kStart.x, 1e-9) << what;
  EXPECT_NEAR(path.poses.back().y, kGoal.y, 1e-9) << what;
  EXPECT_NEAR(path.poses.back().phi, kGoal.phi, 1e-9) << what;
  for (size_t i = 1; i < path.poses.size(); ++i) {
    const auto &a = path.poses[i - 1], &b = path.poses[i];
    EXPECT_TRUE(field.visible({a.x, a.y}, {b.x, b.y}, 0.3)) << what << " at " << i;
  }
  EXPECT_GE(pathLength(path.poses), 6 - 1e-9) << what;
}

class SamplingPlanners : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(SamplingPlanners, FindAPathThatKeepsTheClearanceAndTheSameOneAgain) {
  const auto& [space, word] = GetParam();
  const auto grid = rooms();
  auto params = counted(space);
  if (space != "se2" && word == "rrtstar") params.iterations = 150;  // each of its looks tries many arcs
  if (word == "bitstar") params.iterations = space == "se2" ? 8000 : 3000;  // looks the most often, arcs cost more
  const auto planner = makeSamplingPlanner(word, grid, params);
  const auto first = planner->plan(kStart, kGoal);
  expectAPath(first, grid->field(), space + " " + word);
  if (word == "prmstar") return;  // two threads of OMPL's; documented
  const auto again = planner->plan(kStart, kGoal);
  ASSERT_EQ(first.poses.size(), again.poses.size());
  for (size_t i = 0; i < first.poses.size(); ++i) EXPECT_EQ(first.poses[i], again.poses[i]);
}

/// Those of OMPL's that get to the goal in that many looks.
INSTANTIATE_TEST_SUITE_P(Lines, SamplingPlanners,
                         ::testing::Combine(::testing::Values("se2"), ::testing::ValuesIn(samplingPlanners())));
INSTANTIATE_TEST_SUITE_P(Arcs, SamplingPlanners,
                         ::testing::Combine(::testing::Values("dubins", "reeds-shepp"),
                                            ::testing::Values("rrtconnect", "rrtstar")));
INSTANTIATE_TEST_SUITE_P(ArcsBothWays, SamplingPlanners,
                         ::testing::Combine(::testing::Values("reeds-shepp"), ::testing::Values("bitstar")));

TEST(SamplingPlanner, ArcsHaveTheTurningRadius) {
  const auto grid = rooms();
  auto params = counted("dubins");
  params.turning_radius_m = 0.5;
  const auto path = makeSamplingPlanner("rrtconnect", grid, params)->plan(kStart, kGoal);
  expectAPath(path, grid->field(), "dubins");
  EXPECT_NEAR(path.poses.front().phi, kStart.phi, 1e-9);
  for (size_t i = 1; i < path.poses.size(); ++i) {
    const auto &a = path.poses[i - 1], &b = path.poses[i];
    const double turn = std::abs(std::remainder(b.phi - a.phi, 2 * M_PI)), chord = std::hypot(b.x - a.x, b.y - a.y);
    EXPECT_LE(turn, 1e-6 + 2 * std::asin(std::min(1.0, chord / (2 * 0.5)))) << i;  // of a circle of 0.5 m
  }
}

TEST(SamplingPlanner, AnotherSeedGivesAnotherPath) {
  const auto grid = rooms();
  auto params = counted("se2");
  const auto one = makeSamplingPlanner("rrtstar", grid, params)->plan(kStart, kGoal);
  params.seed = 2;
  const auto two = makeSamplingPlanner("rrtstar", grid, params)->plan(kStart, kGoal);
  EXPECT_NE(pathLength(one.poses), pathLength(two.poses));
}

TEST(SamplingPlanner, TooFewLooksAreAReason) {
  auto params = counted("se2");
  params.iterations = 1;
  const auto path = makeSamplingPlanner("rrtstar", rooms(), params)->plan(kStart, kGoal);
  EXPECT_EQ(path.status, GlobalPath::Status::kTimeOver);
  EXPECT_EQ(path.reason, "no path was found in the time allowed; give more, or another planner");
}

TEST(SamplingPlanner, ARoadmapWithoutDirectionsIsRefusedForDubins) {
  EXPECT_THROW(makeSamplingPlanner("prmstar", rooms(), counted("dubins")), ConfigError);
}

TEST(GlobalPlanners, EachWordMakesAPlannerThatRefusesWhatIsNoPlaceForTheRobot) {
  const auto grid = rooms();
  using Status = GlobalPath::Status;
  for (const auto& word : globalPlanners()) {
    const auto planner = makeGlobalPlanner(word, grid, {});
    EXPECT_EQ(planner->plan({-1, 0, 0}, kGoal).status, Status::kStartOutside) << word;
    EXPECT_EQ(planner->plan(kStart, {4.05, 5.5, 0}).status, Status::kGoalBlocked) << word;
    EXPECT_EQ(planner->plan({std::nan(""), 1, 0}, kGoal).status, Status::kStartOutside) << word;
  }
}

TEST(GlobalPlanners, AMisspeltWordNamesTheNearest) {
  try {
    makeGlobalPlanner("asta", rooms(), {});
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "'asta' is no planner; did you mean 'astar'?");
  }
}

TEST(PathSmoother, RoundsOffKeepsTheClearanceAndTheEnds) {
  const auto grid = rooms();
  for (const char* word : {"astar", "theta", "dijkstra"}) {
    const auto path = makeGlobalPlanner(word, grid, {})->plan(kStart, kGoal);
    const auto smooth = smoothPath(grid->field(), 0.3, {}, path.poses);
    const auto before = pathQuality(grid->field(), path.poses), after = pathQuality(grid->field(), smooth);
    EXPECT_LT(after.bending, 0.8 * before.bending) << word;
    EXPECT_GE(after.clearance_m, 0.3 - 1e-6) << word;
    EXPECT_GE(after.mean_clearance_m, before.mean_clearance_m - 0.05) << word;
    EXPECT_EQ(smooth.front().x, kStart.x);
    EXPECT_EQ(smooth.back(), path.poses.back());
    for (size_t i = 1; i < smooth.size(); ++i)
      EXPECT_TRUE(grid->field().visible({smooth[i - 1].x, smooth[i - 1].y}, {smooth[i].x, smooth[i].y}, 0.3)) << i;
  }
}

TEST(PathQuality, OfAQuarterCircleAndOfASquareCorner) {
  const GridWorld world = drawn(std::vector<std::string>(100, std::string(100, '.')), 0.1);
  const auto field = world.field({.cap_m = 3});
  std::vector<TPose2D> arc;
  for (int i = 0; i <= 900; ++i) {
    const double a = i * M_PI / 1800;
    arc.emplace_back(4 + 2 * std::cos(a), 4 + 2 * std::sin(a), 0);
  }
  const auto round = pathQuality(*field, arc);
  EXPECT_NEAR(round.length_m, M_PI, 1e-5);
  EXPECT_NEAR(round.turning_rad, M_PI / 2, 0.01);
  EXPECT_NEAR(round.bending, 0.25, 0.01);  // radius 2 m
  const auto corner = pathQuality(*field, {{4, 4, 0}, {6, 4, 0}, {6, 6, 0}});
  EXPECT_DOUBLE_EQ(corner.length_m, 4);
  EXPECT_NEAR(corner.turning_rad, M_PI / 2, 1e-12);
  EXPECT_NEAR(corner.clearance_m, 3, 1e-6);
  const auto straight = pathQuality(*field, {{4, 4, 0}, {6, 4, 0}});
  EXPECT_EQ(straight.bending, 0);
  EXPECT_EQ(straight.turning_rad, 0);
}

}  // namespace
}  // namespace sidestep::testing
