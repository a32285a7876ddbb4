// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/crowd.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

/// V(b) of (3)-(4), straight from the paper.
double potential(const SocialForceParams& p, const TPoint2D& r, const TPoint2D& u) {
  const TPoint2D s(u.x * p.look_ahead_s, u.y * p.look_ahead_s);
  const double sum = r.norm() + (r - s).norm();
  return p.people_v0 * std::exp(-0.5 * std::sqrt(sum * sum - s.x * s.x - s.y * s.y) / p.people_sigma_m);
}

TEST(SocialForce, RepulsionIsTheNegativeGradientOfThePotential) {
  const SocialForceParams p;
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const TPoint2D r(random.uniform(-2, 2), random.uniform(0.1, 2)), u(random.uniform(-1.5, 1.5), 0);
    const double h = 1e-6;
    const double fx = -(potential(p, {r.x + h, r.y}, u) - potential(p, {r.x - h, r.y}, u)) / (2 * h);
    const double fy = -(potential(p, {r.x, r.y + h}, u) - potential(p, {r.x, r.y - h}, u)) / (2 * h);
    const TPoint2D f = repulsion(p, r, u);
    EXPECT_NEAR(f.x, fx, 1e-5);
    EXPECT_NEAR(f.y, fy, 1e-5);
  }
}

TEST(SocialForce, IsFiniteWhereSidesAreEven) {
  const SocialForceParams p;
  for (const TPoint2D r : {TPoint2D(0, 0), TPoint2D(1, 0), TPoint2D(2, 0)}) {
    const TPoint2D f = repulsion(p, r, {1, 0});
    EXPECT_TRUE(std::isfinite(f.x) && std::isfinite(f.y));
  }
  EXPECT_EQ(wallRepulsion(p, {0, 0}).x, 0);
  // 10 / 0.2 exp(-1) at one range, away from the wall.
  EXPECT_NEAR(wallRepulsion(p, {0, 0.2}).y, 50 * std::exp(-1), 1e-12);
}

TEST(SocialForce, WhatIsBehindWeighsLess) {
  const SocialForceParams p;                       // 200 degrees, c = 0.5
  EXPECT_EQ(viewWeight(p, {1, 0}, {-1, 0}), 1);    // pushed back by what is ahead
  EXPECT_EQ(viewWeight(p, {1, 0}, {0.17, 1}), 1);  // 99.6 degrees to the right
  EXPECT_EQ(viewWeight(p, {1, 0}, {0.2, 1}), 0.5);
  EXPECT_EQ(viewWeight(p, {1, 0}, {1, 0}), 0.5);
}

PeopleParams walker(double x, double y, double goal_x, double goal_y) {
  PeopleParams p;
  p.x_m = x, p.y_m = y, p.goal_x_m = goal_x, p.goal_y_m = goal_y;
  return p;
}

SocialForceParams calm() {
  SocialForceParams p;
  p.fluctuation = 0;
  return p;
}

void walk(Crowd& crowd, double seconds, const WallIndex& walls = {}, std::span<const Body> robots = {}) {
  for (int k = 1; k * 0.01 <= seconds + 1e-9; ++k) crowd.step(k * 0.01, 0.01, robots, walls);
}

TEST(Crowd, OneAloneRelaxesToTheDesiredSpeed) {
  // v(t) = 1.34 (1 - exp(-t / 0.5)); Euler with 10 ms keeps 0.98^n instead.
  Crowd crowd({walker(0, 0, 100, 0)}, {}, calm(), Random(1));
  walk(crowd, 1);
  EXPECT_NEAR(crowd.people()[0].velocity.x, 1.34 * (1 - std::pow(0.98, 100)), 1e-9);
  EXPECT_EQ(crowd.people()[0].position.y, 0);
}

TEST(Crowd, TheMirroredWorldMovesMirrored) {
  const auto run = [](double sign) {
    Crowd crowd({walker(0, 0, 10, 0), walker(8, sign * 0.3, -5, 0), walker(4, sign * -3, 4, sign * 9)}, {}, calm(),
                Random(1));
    walk(crowd, 6, WallIndex({{{-5, sign * 1.5}, {3, sign * 1.5}}}));
    return crowd.people();
  };
  const auto a = run(1), b = run(-1);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].position.x, b[i].position.x, 1e-9);
    EXPECT_NEAR(a[i].position.y, -b[i].position.y, 1e-9);
  }
  EXPECT_GT(std::abs(a[0].position.y), 0.05) << "nobody made room";
}

TEST(Crowd, WallsAreNotCrossed) {
  // A room of 4 x 4 m whose people all want out through the wall.
  const WallIndex room({{{-2, -2}, {2, -2}}, {{2, -2}, {2, 2}}, {{2, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}});
  PeopleParams p = walker(0, 0, 50, 0);
  p.count = 6, p.start_spread_m = 1.2;
  Crowd crowd({p}, {}, {}, Random(2));
  walk(crowd, 30, room);
  for (const auto& person : crowd.people()) {
    EXPECT_LT(std::abs(person.position.x), 2);
    EXPECT_LT(std::abs(person.position.y), 2);
  }
}

/// Two rooms and a door of 1 m in the wall x = 6, from y = 2.5 to 3.5.
WallIndex twoRooms() {
  return WallIndex({{{0, 0}, {12, 0}},
                    {{12, 0}, {12, 6}},
                    {{12, 6}, {0, 6}},
                    {{0, 6}, {0, 0}},
                    {{6, 0}, {6, 2.5}},
                    {{6, 3.5}, {6, 6}}});
}

TEST(Crowd, PeopleFindTheDoorToAGoalInTheOtherRoom) {
  const WallIndex walls = twoRooms();
  for (uint64_t seed = 1; seed <= 10; ++seed)
    for (const bool told : {false, true}) {
      PeopleParams p = walker(3, 4.5, 10, 1);
      if (told) p.waypoints = {{6, 3}};  // in the door itself
      Crowd crowd({p}, {}, {}, Random(seed));
      walk(crowd, 30, walls);
      // it has arrived 0.33 m before the goal, and coasts on by 1.34 m/s times 0.5 s
      EXPECT_LT((crowd.people()[0].position - TPoint2D(10, 1)).norm(), 1) << seed << (told ? " told" : "");
      EXPECT_TRUE(crowd.stuck().empty());
    }
}

TEST(Crowd, AWaypointBehindAWallIsNotReachedThroughIt) {
  // the waypoint lies 0.15 m behind the wall; only round its end at x = 4 can it be reached
  const WallIndex walls({{{-20, 1}, {4, 1}}});
  PeopleParams p = walker(0, 0.8, 0, -5);
  p.waypoints = {{0, 1.15}};
  Crowd crowd({p}, {}, calm(), Random(1));
  double farthest = 0;
  for (int k = 1; k <= 2000; ++k) {
    crowd.step(k * 0.01, 0.01, {}, walls);
    farthest = std::max(farthest, crowd.people()[0].position.x);
  }
  EXPECT_GT(farthest, 4);
}

TEST(Crowd, WhoGetsNowhereForTenSecondsIsTold) {
  const WallIndex room({{{-2, -2}, {2, -2}}, {{2, -2}, {2, 2}}, {{2, 2}, {-2, 2}}, {{-2, 2}, {-2, -2}}});
  Crowd crowd({walker(0, 0, 50, 0), walker(0, 1, 0, 1)}, {}, calm(), Random(2));
  walk(crowd, 9, room);
  EXPECT_TRUE(crowd.stuck().empty());
  for (int k = 901; k <= 3000; ++k) crowd.step(k * 0.01, 0.01, {}, room);
  const auto stuck = crowd.stuck();
  ASSERT_EQ(stuck.size(), 1u) << "who stands at a goal is not stuck";
  EXPECT_EQ(stuck[0].id, 0);
  EXPECT_GT(stuck[0].position.x, 1);
  EXPECT_GT(stuck[0].for_s, 25);
}

TEST(Crowd, AGroupStaysTogetherAndStrangersDoNot) {
  const auto spread = [](bool group) {
    PeopleParams p = walker(0, 0, 60, 0);
    p.count = 3, p.start_spread_m = 1, p.speed_sd = 0.5, p.group = group;
    Crowd crowd({p}, {}, calm(), Random(5));
    walk(crowd, 30);
    double low = 1e9, high = -1e9;
    for (const auto& person : crowd.people())
      low = std::min(low, person.position.x), high = std::max(high, person.position.x);
    return high - low;
  };
  EXPECT_LT(spread(true), 2.2);
  EXPECT_GT(spread(false), 3.5);
}

TEST(Crowd, StraightWalkersPassAllPointsAndStopReturnOrLeave) {
  PeopleParams p = walker(0, 0, 2, 2);
  p.model = "straight", p.speed = 1, p.waypoints = {{2, 0}};
  p.start_s = 1;
  Crowd crowd({p}, {}, {}, Random(1));
  walk(crowd, 1);
  EXPECT_EQ(crowd.people()[0].position.x, 0);
  walk(crowd, 0);
  for (int k = 101; k <= 300; ++k) crowd.step(k * 0.01, 0.01, {}, {});
  EXPECT_NEAR(crowd.people()[0].position.x, 2, 0.02);
  for (int k = 301; k <= 600; ++k) crowd.step(k * 0.01, 0.01, {}, {});
  EXPECT_NEAR(crowd.people()[0].position.y, 2, 0.02);
  EXPECT_NEAR(crowd.people()[0].walked_m, 4, 0.03);
  EXPECT_EQ(crowd.people()[0].velocity.norm(), 0);
  p.start_s = 0, p.then = "leave";
  Crowd leaving({p}, {}, {}, Random(1));
  walk(leaving, 5);
  EXPECT_FALSE(leaving.people()[0].present);
  p.then = "return";
  Crowd returning({p}, {}, {}, Random(1));
  walk(returning, 8);
  EXPECT_NEAR(returning.people()[0].position.norm(), 0, 0.1);
}

TEST(Crowd, RecordedPeopleAreWhereTheyWere) {
  const std::vector<RecordedTrack> tracks = {{7, {{1, {0, 0}}, {2, {1, 0}}, {4, {1, 4}}}}};
  Crowd crowd({}, tracks, {}, Random(1));
  EXPECT_FALSE(crowd.people()[0].present);
  walk(crowd, 1.5);
  EXPECT_TRUE(crowd.people()[0].present);
  EXPECT_NEAR(crowd.people()[0].position.x, 0.5, 1e-9);
  EXPECT_NEAR(crowd.people()[0].velocity.x, 1, 1e-9);
  crowd.step(3, 0.01, {}, {});
  EXPECT_NEAR(crowd.people()[0].position.y, 2, 1e-9);
  EXPECT_NEAR(crowd.people()[0].velocity.y, 2, 1e-9);
  crowd.step(4.01, 0.01, {}, {});
  EXPECT_FALSE(crowd.people()[0].present);
}

TEST(Crowd, MakesRoomForARobotUnlessBlindToIt) {
  for (const bool sees : {true, false}) {
    PeopleParams p = walker(10, 0.1, -10, 0.1);
    p.sees_robots = sees;
    Crowd crowd({p}, {}, calm(), Random(1));
    double nearest = 1e9;
    for (int k = 1; k <= 800; ++k) {
      const Body robot{{0.008 * k, 0}, {0.8, 0}, 0.3};
      crowd.step(k * 0.01, 0.01, {&robot, 1}, {});
      nearest = std::min(nearest, (crowd.people()[0].position - robot.position).norm());
    }
    if (sees) {
      EXPECT_GT(nearest, 0.9);
    } else {
      EXPECT_LT(nearest, 0.11);
    }
  }
}

TEST(NeighbourGrid, FindsAllWithinTheRadiusAndNobodyElse) {
  Random random(4);
  NeighbourGrid grid;
  for (const size_t n : {1ul, 2ul, 500ul}) {
    std::vector<TPoint2D> points;
    for (size_t i = 0; i < n; ++i) points.emplace_back(random.uniform(-30, 30), random.uniform(-5, 5));
    if (n == 500) points.emplace_back(1e6, 1e6);
    grid.build(points, 2);
    for (const auto& p : points) {
      std::vector<uint32_t> found;
      grid.visit(p, 3.3, [&](uint32_t i) { found.push_back(i); });
      std::sort(found.begin(), found.end());
      std::vector<uint32_t> expected;
      for (uint32_t i = 0; i < points.size(); ++i)
        if ((points[i] - p).norm() <= 3.3) expected.push_back(i);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(WallIndex, FindsTheNearestWallAndWhatBlocksTheView) {
  Random random(4);
  std::vector<Segment> walls;
  for (int i = 0; i < 300; ++i) {
    const TPoint2D a(random.uniform(-40, 40), random.uniform(-40, 40));
    walls.push_back({a, {a.x + random.uniform(-6, 6), a.y + random.uniform(-6, 6)}});
  }
  const WallIndex index(walls);
  std::vector<uint32_t> near;
  for (int k = 0; k < 200; ++k) {
    const TPoint2D p(random.uniform(-50, 50), random.uniform(-50, 50));
    index.near(p, 4, near);
    for (uint32_t i = 0; i < walls.size(); ++i)
      if ((nearestPoint(walls[i], p) - p).norm() <= 4) {
        EXPECT_EQ(std::count(near.begin(), near.end(), i), 1) << i;
      }
  }
  const WallIndex one({{{1, -1}, {1, 1}}});
  EXPECT_TRUE(one.blocks({0, 0}, {2, 0.5}, near));
  EXPECT_FALSE(one.blocks({0, 0}, {0.9, 0}, near));
  EXPECT_FALSE(one.blocks({0, 0}, {2, 3}, near));
}

}  // namespace
}  // namespace sidestep
