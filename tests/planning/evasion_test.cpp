// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/evasion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sidestep {
namespace {

/// A robot that stands at the origin, looks along x and wants to go there.
struct Scene {
  PlanInput input;
  std::vector<MovingObstacle> moving;
  std::vector<Segment> walls;
  ObstacleView view;

  void walker(double x, double y, double vx, double vy) {
    MovingObstacle& o = moving.emplace_back();
    o.position = {x, y}, o.velocity = {vx, vy};
  }
  void look() {
    input.moving = moving;
    input.limits.turn_accel = 2, input.limits.accel = 1;
    MovingView kind;
    kind.kind = MovingView::Kind::kInTime;
    kind.sigmas = 0;
    view.build({{}, walls, moving, nullptr}, kind, {-10, -10, 10, 10}, 1.5);
  }
};

TEST(Evasion, StandingIsFineWhereNobodyComes) {
  Scene s;
  s.walker(3, 3, 1, 0);
  s.look();
  Evasion evasion({});
  EXPECT_TRUE(evasion.stand(s.input, s.view).clear());
  EXPECT_DOUBLE_EQ(evasion.stand(s.input, s.view).command.vx, 0);
}

TEST(Evasion, ARobotThatStandsGetsOutOfTheWayOfSomebodyWhoWalksIntoIt) {
  Scene s;
  s.walker(3, 0.1, -1, 0);  // touches the robot at 0.6 m, after 2.4 s
  s.look();
  Evasion evasion({});
  const auto stand = evasion.stand(s.input, s.view);
  EXPECT_FALSE(stand.clear());
  EXPECT_NEAR(stand.contact_s, 2.4, 0.11);
  const auto best = evasion.best(s.input, s.view, {10, 0});
  ASSERT_TRUE(best.clear());
  EXPECT_GT(best.least_m, 0.1);
  // what it means to drive keeps clear of where the walker is then
  for (const auto& p : evasion.trajectory()) {
    EXPECT_GT(std::hypot(p.pose.x - (3 - p.after_s), p.pose.y - 0.1), 0.6) << p.after_s;
    EXPECT_LE(std::abs(p.v), s.input.limits.v_max + 1e-9);
    EXPECT_LE(std::abs(p.w), s.input.limits.w_max + 1e-9);
  }
}

TEST(Evasion, WhereNothingIsClearTheLatestContactIsBest) {
  // between walls 0.9 m apart, a walker who fills what is left
  Scene s;
  s.walls = {{{-8, 0.45}, {8, 0.45}}, {{-8, -0.45}, {8, -0.45}}};
  s.walker(2, 0, -1.5, 0);
  s.look();
  Evasion evasion({});
  const auto stand = evasion.stand(s.input, s.view), best = evasion.best(s.input, s.view, {10, 0});
  EXPECT_FALSE(best.clear());
  EXPECT_GE(best.contact_s, stand.contact_s);
  EXPECT_LE(best.command.vx, 1e-9);  // backwards, or not at all
}

}  // namespace
}  // namespace sidestep
