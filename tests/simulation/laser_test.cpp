// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/laser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Distance along a ray to a wall and to a disc by their textbook equations, beam by beam.
double rayToWall(const TPoint2D& o, double angle, const Segment& w) {
  const TPoint2D d(std::cos(angle), std::sin(angle)), e = w.b - w.a, f = w.a - o;
  const double det = d.x * e.y - d.y * e.x;
  const double t = (f.x * e.y - f.y * e.x) / det, u = (f.x * d.y - f.y * d.x) / det;
  return t >= 0 && u >= 0 && u <= 1 ? t : kNever;
}

double rayToDisc(const TPoint2D& o, double angle, const SeenDisc& disc) {
  const TPoint2D f = disc.position - o;
  const double b = f.x * std::cos(angle) + f.y * std::sin(angle);
  const double root = b * b - (f.x * f.x + f.y * f.y - disc.radius_m * disc.radius_m);
  return root >= 0 && b > 0 ? b - std::sqrt(root) : kNever;
}

TEST(Laser, AgreesWithEachBeamByItself) {
  Random random(3);
  for (int round = 0; round < 30; ++round) {
    std::vector<Segment> walls;
    std::vector<SeenDisc> discs;
    for (int i = 0; i < 20; ++i) {
      const TPoint2D a(random.uniform(-12, 12), random.uniform(-12, 12));
      walls.push_back({a, {a.x + random.uniform(-4, 4), a.y + random.uniform(-4, 4)}});
    }
    const mrpt::math::TPose2D pose(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-4, 4));
    for (int i = 0; i < 10; ++i) {
      const double angle = random.uniform(-4, 4), d = random.uniform(1, 9);
      discs.push_back({{pose.x + d * std::cos(angle), pose.y + d * std::sin(angle)}, 0.3});
    }
    LaserParams p;
    p.field = round % 2 == 0 ? 2 * M_PI : 1.5 * M_PI;
    p.beams = 361;
    p.range_m = 8;
    LaserScanner laser(p);
    const auto ranges = laser.cast(pose, WallIndex(walls), discs);
    int hits = 0;
    for (size_t i = 0; i < ranges.size(); ++i) {
      const double angle = pose.phi + laser.bearing(i);
      double expected = kNever;
      for (const auto& w : walls) expected = std::min(expected, rayToWall({pose.x, pose.y}, angle, w));
      for (const auto& d : discs) expected = std::min(expected, rayToDisc({pose.x, pose.y}, angle, d));
      if (expected > p.range_m) expected = kNever;
      if (std::isfinite(expected)) {
        EXPECT_NEAR(ranges[i], expected, 1e-9) << i;
        ++hits;
      } else {
        EXPECT_EQ(ranges[i], expected) << i;
      }
    }
    EXPECT_GT(hits, 100);
  }
}

TEST(Laser, LooksFromItsPlaceOnTheRobot) {
  LaserParams p;
  p.x_m = 0.5, p.yaw = M_PI / 2, p.beams = 3, p.field = 0.2;
  LaserScanner laser(p);
  // The robot at the origin heads up; the laser is at (0, 0.5) and looks along -x, at a wall at x = -3.
  const auto ranges = laser.cast({0, 0, M_PI / 2}, WallIndex({{{-3, -5}, {-3, 5}}}), {});
  EXPECT_NEAR(ranges[1], 3, 1e-12);
  EXPECT_NEAR(ranges[0], 3 / std::cos(0.1), 1e-12);
}

TEST(Laser, AWallThroughTheBeamsOriginAndADiscAroundItAreNoHarm) {
  LaserParams p;
  p.field = 2 * M_PI, p.beams = 360;
  LaserScanner laser(p);
  for (const double r : laser.cast({0, 0, 0}, WallIndex({{{-1, 0}, {1, 0}}, {{0, 0}, {0, 0}}}), {}))
    EXPECT_FALSE(std::isnan(r));
  const std::vector<SeenDisc> around = {{{0.1, 0}, 1}};
  for (const double r : laser.cast({0, 0, 0}, WallIndex(), around)) EXPECT_EQ(r, 0);
}

TEST(Laser, NoiseAndLostEchoesAreAsSaid) {
  LaserParams p;
  p.beams = 20001, p.field = 1, p.range_sd_m = 0.05, p.dropout = 0.1;
  LaserScanner laser(p);
  const WallIndex wall({{{5, -9}, {5, 9}}});
  const auto exact = laser.cast({0, 0, 0}, wall, {});
  Random random(1);
  laser.disturb(random);
  double lost = 0, squares = 0, n = 0;
  for (size_t i = 0; i < exact.size(); ++i) {
    if (!std::isfinite(laser.ranges()[i])) {
      lost += 1;
      continue;
    }
    squares += std::pow(laser.ranges()[i] - exact[i], 2), n += 1;
  }
  EXPECT_NEAR(lost / 20001, 0.1, 4 * std::sqrt(0.09 / 20001));
  EXPECT_NEAR(std::sqrt(squares / n), 0.05, 4 * 0.05 / std::sqrt(2 * n));
}

TEST(Laser, WalkingLegsSwingAboutTheBody) {
  Person p;
  p.velocity = {1, 0};
  std::vector<SeenDisc> legs;
  p.walked_m = 0.35;  // a quarter of a stride: legs farthest apart
  addLegs(p, legs);
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_NEAR(legs[0].position.x, 0.3, 1e-12);
  EXPECT_NEAR(legs[0].position.y, 0.12, 1e-12);
  EXPECT_NEAR(legs[1].position.x, -0.3, 1e-12);
  EXPECT_NEAR(legs[1].position.y, -0.12, 1e-12);
  p.velocity = {0, 0};
  legs.clear();
  addLegs(p, legs);
  EXPECT_EQ(legs[0].position.x, 0);
}

}  // namespace
}  // namespace sidestep
