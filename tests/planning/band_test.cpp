// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/band.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "planning/band/band_optimizer.h"
#include "planning/band/gap_graph.h"
#include "planning/band/signature.h"

namespace sidestep {
namespace {

Band straight(double length, int intervals, double time) {
  Band band;
  for (int k = 0; k <= intervals; ++k) band.push_back({length * k / intervals, 0, 0, time * k / intervals});
  return band;
}

TEST(Band, IsInterpolatedAlongTheArc) {
  // a quarter of the unit circle around (0, 1): half way is at 45 degrees of it
  const Band band = {{0, 0, 0, 0}, {1, 1, M_PI / 2, 2}};
  const BandPose half = bandAt(band, 1);
  EXPECT_NEAR(half.x, std::sin(M_PI / 4), 1e-12);
  EXPECT_NEAR(half.y, 1 - std::cos(M_PI / 4), 1e-12);
  EXPECT_NEAR(half.theta, M_PI / 4, 1e-12);
}

TEST(Band, TheProfileOfAStraightLineIsTheShortestOne) {
  // 8 m at 1 m/s and 0.5 m/s^2: 2 s up over 1 m, 6 s, 2 s down; 1 m is a triangle of 2 sqrt(1 / 0.5)
  const RobotLimits limits;
  const SpeedProfile eight(8, 0, limits, true), one(1, 0, limits, true);
  EXPECT_NEAR(eight.duration(), 10, 1e-12);
  EXPECT_NEAR(eight.wayAt(5), 4, 1e-12);
  EXPECT_NEAR(eight.wayAt(9), 7.75, 1e-12);
  EXPECT_NEAR(one.duration(), 2 * std::sqrt(2.0), 1e-12);
}

TEST(Band, RetimingLeavesNothingBeyondTheLimits) {
  Random random(5);
  const RobotLimits limits;
  for (int n = 0; n < 200; ++n) {
    Band band = {{0, 0, 0, 0}};
    for (int k = 1; k < 20; ++k)
      band.push_back(
          {0.3 * k + random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.5, 0.5), 0.1 * k});
    retime(band, limits, {});
    const BandExtremes most = extremesOf(band, {});
    EXPECT_LE(most.v, limits.v_max * 1.001);
    EXPECT_LE(most.w, limits.w_max * 1.001);
    EXPECT_LE(most.a, limits.accel * 1.01);
    EXPECT_LE(most.turn_accel, limits.turn_accel * 1.01);
  }
}

TEST(Band, RetimingLeavesAFeasibleBandAsItIs) {
  Band band = straight(4, 10, 10);  // 0.4 m/s, reached in half an interval: 0.8 m/s^2, too much at both ends only
  RobotLimits limits;
  limits.accel = limits.brake = 0.9;
  const Band before = band;
  retime(band, limits, {});
  for (size_t k = 0; k < band.size(); ++k) EXPECT_EQ(band[k].t, before[k].t);
}

TEST(Band, RetimingOfATurnTooSmallToSeeAgainstTheRobotsOwnStaysFinite) {
  // found by the fuzzer: the robot turns to the right, the band by 1e-17 rad to the left
  Band band = {{0, 0, 0, 0}, {0.2, 0, 1e-17, 0.3}, {0.4, 0, 1e-17, 0.6}, {0.6, 0, 1e-17, 0.9}};
  retime(band, {}, {0.3, -1.4, true});
  for (const auto& p : band) EXPECT_LT(p.t, 100);
}

TEST(Band, RetimedFromScratchAStraightBandNeedsTheShortestTime) {
  Band band = straight(8, 40, 20);
  retime(band, {}, {}, Retiming::kQuickest);
  EXPECT_GE(band.back().t, 10 - 1e-6);  // the shortest possible, see above
  EXPECT_LE(band.back().t, 10.1);       // what the ends lose to poses 0.2 m apart
}

TEST(Band, OptimizedAStraightBandNeedsHardlyMoreThanTheShortestTime) {
  Band band = straight(8, 30, 11);
  BandParams params;
  params.iterations_cold = 400;
  params.tolerance = 1e-9;
  BandOptimizer optimizer({}, params);
  BandProblem problem;
  optimizer.optimize(problem, false, {}, band);
  retime(band, problem.limits, problem.ends);
  EXPECT_GE(band.back().t, 10 - 1e-6);
  EXPECT_LE(band.back().t, 10.3);  // limit_share 0.99 and rounded-off limits
}

struct Way {
  std::vector<GapPath> paths;
  size_t found;
};

Way waysThrough(const std::vector<mrpt::math::TPoint2D>& points, const std::vector<Segment>& walls,
                ObstacleView& view) {
  view.build({points, walls, {}, nullptr}, {}, {-3, -8, 13, 8}, 0.8);
  static GapGraph graph{ExplorationParams{}};
  const RobotLimits limits;
  const auto& paths = graph.search({GoalFrame(0, 0, 10, 0), &view, 0.35, 0.8, SpeedProfile(10, 0, limits, true)});
  return {paths, graph.found()};
}

Band bandAlong(const GapPath& path) {
  Band band;
  for (const auto& p : path.points) band.push_back({p.x, p.y, 0, static_cast<double>(band.size())});
  return band;
}

TEST(GapGraph, OneObstacleIsPassedOnTwoSidesAndTheirSignaturesDiffer) {
  ObstacleView view;
  const Way ways = waysThrough({{5, 0.1}}, {}, view);
  ASSERT_EQ(ways.found, 2u);
  SignatureReader reader;
  const GoalFrame frame(0, 0, 10, 0);
  const auto first = reader.read(bandAlong(ways.paths[0]), frame, view, 10);
  const auto second = reader.read(bandAlong(ways.paths[1]), frame, view, 10);
  EXPECT_NE(first, second);
  for (size_t k = 0; k < 2; ++k)
    for (const auto& p : ways.paths[k].points) EXPECT_GE(std::hypot(p.x - 5, p.y - 0.1), 0.349);
}

TEST(GapGraph, AGapTooNarrowForTheRobotIsNoWay) {
  // walls from far below to far above with a gap of 0.6 m; the robot with its margin needs 0.7 m
  ObstacleView view;
  EXPECT_EQ(waysThrough({}, {{{5, -7}, {5, -0.3}}, {{5, 0.3}, {5, 7}}}, view).found, 0u);
  EXPECT_EQ(waysThrough({}, {{{5, -7}, {5, -0.5}}, {{5, 0.5}, {5, 7}}}, view).found, 1u);
}

TEST(GapGraph, NoMoreThanClassesMaxOfManyObstaclesCheapestFirst) {
  Random random(2);
  std::vector<mrpt::math::TPoint2D> points;
  for (int i = 0; i < 60; ++i) points.push_back({random.uniform(1, 9), random.uniform(-5, 5)});
  ObstacleView view;
  const Way ways = waysThrough(points, {}, view);
  ASSERT_EQ(ways.found, 4u);
  for (size_t k = 1; k < 4; ++k) EXPECT_LE(ways.paths[k - 1].cost, ways.paths[k].cost);
}

TEST(Signature, PassingAMovingObstacleInFrontAndBehindDiffer) {
  // it crosses the line at (5, 0) at t = 5; the robot is there at t = 3.3 or at t = 6.7
  std::vector<MovingObstacle> moving(1);
  moving[0].position = {5, -5};
  moving[0].velocity = {0, 1};
  MovingView in_time;
  in_time.kind = MovingView::Kind::kInTime;
  ObstacleView view;
  view.build({{}, {}, moving, nullptr}, in_time, {-3, -8, 13, 8}, 0.8);
  SignatureReader reader;
  const GoalFrame frame(0, 0, 10, 0);
  const auto quick = reader.read(straight(10, 40, 6.6), frame, view, 12);
  const auto slow = reader.read(straight(10, 40, 13.4), frame, view, 12);
  EXPECT_NE(quick, slow);
  EXPECT_EQ(quick, reader.read(straight(10, 25, 6.0), frame, view, 12));
}

}  // namespace
}  // namespace sidestep
