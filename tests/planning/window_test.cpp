// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The dynamic window: closed forms of its parts.
#include <gtest/gtest.h>

#include "core/kinematics.h"
#include "planning/planners.h"
#include "planning/window/clearance_scorer.h"
#include "planning/window/heading_scorer.h"
#include "planning/window/hrvo_heading_scorer.h"
#include "planning/window/hrvo_speed_scorer.h"
#include "planning/window/speed_scorer.h"
#include "planning/window/surroundings.h"
#include "planning/window/window_planner.h"
#include "support/planning_worlds.h"

namespace sidestep::testing {
namespace {

using support::openWorld;
using support::person;

Rollout rollout(double v, double w) {
  Rollout r;
  r.v = v;
  r.w = w;
  return r;
}

/// Follows (v, w) for 3 s.
Rollout followed(const PlanInput& input, double v, double w, bool predict = true, double step_s = 0.1) {
  Surroundings s;
  s.look(input, 3, step_s, 0, predict, 0);
  std::vector<double> x, y;
  for (int k = 0; k <= s.steps(); ++k) {
    const auto p = arcFromOrigin(k * s.step(), w * (k * s.step()));
    x.push_back(p.x);
    y.push_back(p.y);
  }
  Rollout r = rollout(v, w);
  s.follow(x, y, r);
  return r;
}

TEST(Rollout, IsTheExactArc) {
  // A quarter of a circle of radius 1 m: from (0, 0) to (1, 1), heading 90 deg.
  const auto p = arcFromOrigin(M_PI / 2, M_PI / 2);
  EXPECT_NEAR(p.x, 1, 1e-12);
  EXPECT_NEAR(p.y, 1, 1e-12);
  EXPECT_NEAR(p.phi, M_PI / 2, 1e-12);
  EXPECT_NEAR(arcFromOrigin(6, 0).x, 6, 1e-12);
}

TEST(Scorers, HaveTheValuesOfTheirFormulas) {
  ScoringView view;
  view.goal_x = 2;
  view.goal_y = 2;
  view.v_max = 2;
  view.adviser_heading = -0.5;
  view.adviser_speed = 0.5;
  // At (1, 0) heading 0 the goal stands at atan2(2, 1) (2.27).
  EXPECT_NEAR(HeadingScorer(1).score(rollout(1, 0), view), 1 - std::atan2(2, 1) / M_PI, 1e-12);
  EXPECT_NEAR(HrvoHeadingScorer(1, true).score(rollout(1, 0), view), 1 - (std::atan2(2, 1) + 0.5) / M_PI, 1e-12);
  EXPECT_NEAR(HrvoHeadingScorer(1, false).score(rollout(1, 0), view), 1 - 0.5 / M_PI, 1e-12);
  EXPECT_NEAR(HrvoHeadingScorer(1, false).score(rollout(1, -0.5), view), 1, 1e-12);
  EXPECT_NEAR(SpeedScorer().score(rollout(0.5, 0), view), 0.25, 1e-12);
  EXPECT_NEAR(HrvoSpeedScorer().score(rollout(0.5, 0), view), 1, 1e-12);
  EXPECT_NEAR(HrvoSpeedScorer().score(rollout(1.5, 0), view), 0.5, 1e-12);
  Rollout r = rollout(1, 0);
  EXPECT_EQ(ClearanceScorer().score(r, view), 1);
  r.free_s = 1.5;  // 1.5 m of 2 m/s * 3 s
  EXPECT_NEAR(ClearanceScorer().score(r, view), 0.25, 1e-12);
}

TEST(Scorers, ThePrintedHeadingRewardsTheWrongSide) {
  // The goal is ahead, the HRVO velocity points left: as printed, turning right scores higher.
  ScoringView view;
  view.goal_x = 5;
  view.adviser_heading = 0.4;
  const HrvoHeadingScorer printed(3, true), aligned(3, false);
  EXPECT_GT(printed.score(rollout(1, -0.2), view), printed.score(rollout(1, 0.2), view));
  EXPECT_LT(aligned.score(rollout(1, -0.2), view), aligned.score(rollout(1, 0.2), view));
}

TEST(Surroundings, AWallAheadIsTouchedWhenTheGapIsDriven) {
  // Wall at 1.55 m, radius 0.3: 1.25 m at 1 m/s; found at 1.3 s, the last free step is 1.2 s.
  auto world = openWorld();
  world.walls = {{{1.55, -2}, {1.55, 2}}};
  EXPECT_NEAR(followed(world.shown(), 1, 0).free_s, 1.2, 1e-9);
  EXPECT_EQ(followed(world.shown(), 1, 0).touched, -1);
  EXPECT_EQ(followed(world.shown(), 0.3, 0).free_s, std::numeric_limits<double>::infinity());
}

TEST(Surroundings, APointOnTheArcIsTouchedAndOneBesideItIsNot) {
  // Arc of radius 1 m around (0, 1): a point on it, 90 deg on, is touched 2 asin(0.15) rad earlier.
  auto world = openWorld();
  world.points = {{1, 1}};
  EXPECT_NEAR(followed(world.shown(), 1, 1).free_s, M_PI / 2 - 2 * std::asin(0.15), 0.1);
  world.points = {{0.6, 1}, {1.4, 1}};  // 0.4 m inside and outside of the circle
  EXPECT_EQ(followed(world.shown(), 1, 1).free_s, std::numeric_limits<double>::infinity());
}

TEST(Surroundings, MovingObstaclesAreMetWhereTheyWillBe) {
  // 4 m apart, closing at 2 m/s, radii 0.6: touch after 1.7 s. Standing, after 3.4 s: never within 3 s.
  auto world = openWorld();
  world.moving = {person(4, 0, -1, 0)};
  EXPECT_NEAR(followed(world.shown(), 1, 0).free_s, 1.65, 0.06);
  EXPECT_EQ(followed(world.shown(), 1, 0).touched, 0);
  EXPECT_EQ(followed(world.shown(), 1, 0, false).free_s, std::numeric_limits<double>::infinity());
  // One that crosses is hit only if both are there at the same time.
  world.moving = {person(2, -2, 0, 1)};
  EXPECT_LT(followed(world.shown(), 1, 0).free_s, 2);
  EXPECT_EQ(followed(world.shown(), 0.3, 0).free_s, std::numeric_limits<double>::infinity());
}

/// Whether the robot at 1 m/s, driving straight on for 0.25 s and braking by 1 m/s^2, can stay where it stops, 0.75 m
/// on.
bool canStop(const PlanInput& input) {
  Surroundings s;
  s.look(input, 3, 0.1, 0, true, 0);
  std::vector<double> x, y;
  for (int k = 0; k <= s.steps(); ++k) {
    x.push_back(k * s.step());
    y.push_back(0);
  }
  return s.canStop(x, y, rollout(1, 0), 0.25, 1);
}

TEST(Surroundings, StandingWhereSomebodyComesIsNoWayOut) {
  auto world = openWorld();
  EXPECT_TRUE(canStop(world.shown()));
  // A wall beyond the stop is no matter, one before it is. Radius 0.3.
  world.walls = {{{1.1, -2}, {1.1, 2}}};
  EXPECT_TRUE(canStop(world.shown()));
  world.walls = {{{0.9, -2}, {0.9, 2}}};
  EXPECT_FALSE(canStop(world.shown()));
  world.walls.clear();
  // Who stands behind the stop leaves room; who comes along the line does not, even if only after the look-ahead
  // of 3 s, when 5 m off at 1 m/s; who comes later than twice that does not count.
  world.moving = {person(2, 0, 0, 0)};
  EXPECT_TRUE(canStop(world.shown()));
  world.moving = {person(2, 0, -1, 0)};
  EXPECT_FALSE(canStop(world.shown()));
  world.moving = {person(5, 0, -1, 0)};
  EXPECT_FALSE(canStop(world.shown()));
  world.moving = {person(8, 0, -1, 0)};
  EXPECT_TRUE(canStop(world.shown()));
  // Who crosses behind or beside the place where it stops is let by.
  world.moving = {person(0.75, -2, 0, 1)};
  EXPECT_FALSE(canStop(world.shown()));
  world.moving = {person(1.4, -2, 0, 1)};
  EXPECT_TRUE(canStop(world.shown()));
}

TEST(Surroundings, PredictedPathsAndGrowingDoubtAreFollowed) {
  // Stands for 1 s, then comes at 1 m/s.
  auto world = openWorld();
  world.moving = {person(4, 0, -1, 0)};
  world.moving[0].predicted = {{1, {4, 0}, Eigen::Matrix2d::Zero()}, {5, {0, 0}, Eigen::Matrix2d::Zero()}};
  EXPECT_NEAR(followed(world.shown(), 1, 0).free_s, 2.15, 0.06);  // 4 - t - (t - 1) = 0.6
  Surroundings s;
  world.moving[0].predicted[1].covariance = Eigen::Matrix2d::Identity() * 0.64;  // sd 0.8 at 5 s, 0.2 a second
  s.look(world.shown(), 3, 0.1, 0, true, 1);
  std::vector<double> x, y(31, 0.0);
  for (int k = 0; k <= 30; ++k) x.push_back(0.1 * k);
  Rollout r = rollout(1, 0);
  s.follow(x, y, r);
  EXPECT_NEAR(r.free_s, 4.6 / 2.2 - 0.05, 0.06);  // 5 - 2 t = 0.6 + 0.2 (t - 1)
}

TEST(Surroundings, SkippingStepsMissesNothing) {
  // The same with all steps looked at: against a brute-force walk.
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    auto world = support::crowdedWorld(random, 10);
    world.input.pose = {0, 0, 0};
    const double v = random.uniform(0, 1), w = random.uniform(-1, 1);
    const Rollout r = followed(world.shown(), v, w);
    double first = std::numeric_limits<double>::infinity();
    for (int k = 1; k <= 30 && !std::isfinite(first); ++k) {
      const auto p = arcFromOrigin(v * (0.1 * k), w * (0.1 * k));
      for (const auto& m : world.moving) {
        const double d =
            std::hypot(m.position.x + m.velocity.x * 0.1 * k - p.x, m.position.y + m.velocity.y * 0.1 * k - p.y);
        const double radius = std::min(0.6, m.position.norm() - 1e-3);
        if (d < radius - 1e-5) first = 0.1 * (k - 1);
      }
    }
    if (std::isfinite(first)) {
      EXPECT_NEAR(r.free_s, first, 1e-6) << i;
    } else {
      EXPECT_FALSE(r.free_s < 2.9 && r.gap_m < -1e-4) << i;
    }
  }
}

TEST(Dwa, DoesNotDriveFasterThanItCanStop) {
  // Wall 0.6 m ahead of the rim. At 1 m/s 0.35 m would be left after the period, and stopping takes 0.5 m (2.24).
  LocalPlannerParams params;
  params.of<WindowParams>().margin_m = 0;
  auto world = openWorld(1);
  world.walls = {{{0.9, -5}, {0.9, 5}}};
  PlanOutput out;
  makeLocalPlanner("dwa", params)->plan(world.shown(), out);
  EXPECT_LT(out.command.vx, 1);
  EXPECT_LE(out.command.vx * out.command.vx / 2, 0.6 - out.command.vx * 0.25);
  EXPECT_EQ(out.status, PlanOutput::Status::kMoving);
}

TEST(Dwa, BrakesInFrontOfAWallAcrossTheWay) {
  // Driven in closed loop, it stands still before the wall and does not touch it.
  const auto planner = makeLocalPlanner("dwa");
  auto world = openWorld(1);
  world.walls = {{{4, -20}, {4, 20}}};
  world.input.limits.w_max = 0.01;  // cannot turn away
  PlanOutput out;
  for (int i = 0; i < 100; ++i) {
    planner->plan(world.shown(), out);
    world.input.pose.x += 0.5 * (world.input.twist.vx + out.command.vx) * 0.25;
    world.input.twist.vx = out.command.vx;
    ASSERT_LT(world.input.pose.x, 3.7) << "step " << i;
  }
  EXPECT_NEAR(world.input.twist.vx, 0, 0.05);
  EXPECT_GT(world.input.pose.x, 2.5);
}

TEST(Dwa, ExplainsWhyOthersLost) {
  auto world = openWorld(0.8);
  world.moving = {person(1.6, 0, -1, 0)};
  const auto planner = makeLocalPlanner("dwa");
  planner->explain(true);
  PlanOutput out;
  planner->plan(world.shown(), out);
  EXPECT_EQ(out.candidates.size(), 11u * 21u);
  bool collision = false;
  for (const auto& c : out.candidates) collision |= c.rejected.find("moving obstacle 0") != std::string::npos;
  EXPECT_TRUE(collision);
  ASSERT_EQ(out.costs.size(), 3u);
  EXPECT_EQ(out.costs[0].first, "heading");
}

TEST(Edwa, TurnsAsideLongBeforeDwaDoes) {
  // One comes head-on 6 m away: HRVO turns now, the target heading does not.
  auto world = openWorld(1);
  world.moving = {person(6, 0, -1, 0)};
  PlanOutput dwa, edwa;
  makeLocalPlanner("dwa")->plan(world.shown(), dwa);
  makeLocalPlanner("edwa")->plan(world.shown(), edwa);
  EXPECT_NEAR(dwa.command.omega, 0, 1e-9);
  EXPECT_LT(edwa.command.omega, -0.05);   // head-on: to the right
  EXPECT_NEAR(edwa.command.vx, 1, 0.05);  // and at full speed
}

}  // namespace
}  // namespace sidestep::testing
