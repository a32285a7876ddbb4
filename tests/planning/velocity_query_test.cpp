// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/velocity/velocity_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace sidestep::testing {
namespace {

using mrpt::math::TPoint2D;
constexpr double kForever = 1e6;

DiscView discAt(double x, double y, double vx, double vy, double radius_sum = 0.6) {
  return {{x, y}, {vx, vy}, radius_sum, 0, 0.5};
}

/// Discs, walls and shields of a random place.
std::vector<VelocityRegion> randomRegions(Random& random) {
  std::vector<VelocityRegion> out;
  const TPoint2D own{random.uniform(-1, 1), random.uniform(-1, 1)};
  const double horizon = random.uniform() < 0.5 ? kForever : random.uniform(0.5, 8);
  for (auto n = random.below(12); n > 0; --n) {
    const double a = random.uniform(-M_PI, M_PI), d = random.uniform(0.3, 6);
    const auto disc = discAt(d * std::cos(a), d * std::sin(a), random.uniform(-1, 1), random.uniform(-1, 1));
    out.push_back(discRegion(static_cast<RegionKind>(random.below(3)), disc, own, horizon, 1));
    if (random.uniform() < 0.3) out.push_back(shieldRegion(disc, 0.25));
  }
  for (auto n = random.below(4); n > 0; --n) {
    const TPoint2D a{random.uniform(-4, 4), random.uniform(-4, 4)};
    const TPoint2D b = a + TPoint2D{random.uniform(-3, 3), random.uniform(-3, 3)};
    out.push_back(wallRegion({a, b}, 0.3, 2, 1));
  }
  return out;
}

/// Distance of the nearest free point of a grid in the disc; infinity if none is free.
double nearestOnGrid(const std::vector<VelocityRegion>& regions, const TPoint2D& preferred, double v_max, double step) {
  double best = std::numeric_limits<double>::infinity();
  for (double x = -v_max; x <= v_max; x += step)
    for (double y = -v_max; y <= v_max; y += step) {
      const TPoint2D v{x, y};
      const double d = (v - preferred).norm();
      if (d >= best || v.norm() > v_max) continue;
      if (std::none_of(regions.begin(), regions.end(), [&](const auto& r) { return r.contains(v); })) best = d;
    }
  return best;
}

TEST(VelocityQuery, IsNeverFartherFromThePreferredVelocityThanAFineGrid) {
  Random random(1);
  int blocked = 0, free = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto regions = randomRegions(random);
    const TPoint2D preferred{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2)};
    VelocityQuery query;
    for (const auto& r : regions) query.add(r);
    VelocityCandidate best;
    const double on_grid = nearestOnGrid(regions, preferred, 1, 0.005);
    if (!query.nearest(preferred, 1, best)) {
      EXPECT_EQ(on_grid, std::numeric_limits<double>::infinity()) << "case " << i;
      ++blocked;
      continue;
    }
    ASSERT_LE(best.distance, on_grid + 1e-9) << "case " << i;
    ASSERT_NEAR((best.velocity - preferred).norm(), best.distance, 1e-9) << "case " << i;
    ASSERT_LE(best.velocity.norm(), 1 + 1e-9) << "case " << i;
    for (const auto& r : regions) {  // on an edge at most, never inside
      double depth = 1e9;
      for (const auto& s : r.sides) depth = std::min(depth, s.nx * best.velocity.x + s.ny * best.velocity.y - s.c);
      ASSERT_LE(depth, 1e-8) << "case " << i;
    }
    free += best.region < 0;
  }
  EXPECT_GT(blocked, 50);  // all three kinds of answers are there
  EXPECT_GT(free, 1000);
  EXPECT_LT(free + blocked, 9000);
}

TEST(VelocityQuery, OfAHeadOnDiscGoesAlongTheTangent) {
  // A standing disc of radius sum 1 at (2, 0): legs at asin(1/2) = 30 deg from the apex 0. The nearest point of either
  // leg to (1, 0) is cos 30 deg along it, at distance sin 30 deg.
  VelocityQuery query;
  query.add(discRegion(RegionKind::kVo, discAt(2, 0, 0, 0, 1), {1, 0}, kForever, 1));
  VelocityCandidate best;
  ASSERT_TRUE(query.nearest({1, 0}, 1, best));
  EXPECT_NEAR(best.distance, 0.5, 1e-9);
  EXPECT_NEAR(best.velocity.x, 0.75, 1e-9);
  EXPECT_NEAR(std::abs(best.velocity.y), std::sqrt(3.0) / 4, 1e-9);
}

TEST(VelocityQuery, APreferredVelocityThatIsTooFastIsShortened) {
  VelocityQuery query;
  VelocityCandidate best;
  ASSERT_TRUE(query.nearest({3, 4}, 1, best));
  EXPECT_NEAR(best.velocity.x, 0.6, 1e-12);
  EXPECT_NEAR(best.velocity.y, 0.8, 1e-12);
  EXPECT_NEAR(best.distance, 4, 1e-12);
}

TEST(VelocityQuery, WhereConesMeetTheSolutionIsTheirCorner) {
  // Two standing discs close together ahead: their VOs overlap; the solution lies on an outer leg, outside of both.
  VelocityQuery query;
  const auto left = discRegion(RegionKind::kVo, discAt(2, 0.5, 0, 0, 1), {1, 0}, kForever, 1);
  const auto right = discRegion(RegionKind::kVo, discAt(2, -0.5, 0, 0, 1), {1, 0}, kForever, 1);
  query.add(left);
  query.add(right);
  VelocityCandidate best;
  ASSERT_TRUE(query.nearest({1, 0}, 1, best));
  // Legs at +-(atan(1/4) + asin(1/sqrt(4.25))): distance to (1, 0) is the sine of that angle.
  EXPECT_NEAR(best.distance, std::sin(std::atan(0.25) + std::asin(1 / std::sqrt(4.25))), 1e-9);
}

TEST(VelocityQuery, WhenAllIsForbiddenItSaysSo) {
  VelocityQuery query;
  VelocityRegion all;
  all.sides.fill({1, 0, -5});
  query.add(all);
  VelocityCandidate best;
  EXPECT_FALSE(query.nearest({1, 0}, 1, best));
  EXPECT_EQ(query.coveredBy({0.3, 0.2}), 0);
}

TEST(VelocityQuery, MirroredRegionsGiveTheMirroredVelocity) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    VelocityQuery query, mirrored;
    const TPoint2D own{random.uniform(-1, 1), random.uniform(-1, 1)}, preferred{random.uniform(-1, 1), 0.7};
    for (int k = 0; k < 8; ++k) {
      const double x = random.uniform(-4, 4), y = random.uniform(1, 4), vx = random.uniform(-1, 1),
                   vy = random.uniform(-1, 1);
      query.add(discRegion(RegionKind::kHrvo, discAt(x, y, vx, vy), own, 6, 1));
      mirrored.add(discRegion(RegionKind::kHrvo, discAt(-x, y, -vx, vy), {-own.x, own.y}, 6, 1));
    }
    VelocityCandidate a, b;
    ASSERT_EQ(query.nearest(preferred, 1, a), mirrored.nearest({-preferred.x, preferred.y}, 1, b));
    ASSERT_NEAR(a.distance, b.distance, 1e-9);
  }
}

TEST(VelocityRegion, ApexesLieWhereFigure24PutsThem) {
  // Robot at rest speed (0, 1), disc ahead at (0, 4) coming with (0, -1).
  const auto disc = discAt(0.0, 4, 0, -1);
  const TPoint2D own{0, 1};
  const auto vo = discRegion(RegionKind::kVo, disc, own, kForever, 1);
  EXPECT_NEAR(vo.edges[0].from.y, -1, 1e-5);
  const auto rvo = discRegion(RegionKind::kRvo, disc, own, kForever, 1);
  EXPECT_NEAR(rvo.edges[0].from.y, 0, 1e-5);
  // The robot passes right of the disc: the right leg is that of the RVO, the left one that of the VO.
  const TPoint2D passing{0.2, 1};
  const auto hrvo = discRegion(RegionKind::kHrvo, disc, passing, kForever, 1);
  const auto apex = hrvo.edges[0].from;
  const double s = 0.6 / 4, c = std::sqrt(1 - s * s);
  const TPoint2D left{-s, c}, right{s, c}, v_rvo{0.1, 0};
  EXPECT_NEAR((apex.x - 0) * left.y - (apex.y + 1) * left.x, 0, 1e-5);
  EXPECT_NEAR((apex.x - v_rvo.x) * right.y - (apex.y - v_rvo.y) * right.x, 0, 1e-5);
}

TEST(VelocityRegion, AHorizonCutsTheTip) {
  // Gap 4 - 0.6 = 3.4 m to a standing disc; 2 s ahead: less than 1.7 m/s towards it is free.
  const auto region = discRegion(RegionKind::kVo, discAt(0, 4, 0, 0), {0, 1}, 2, 1);
  EXPECT_FALSE(region.contains({0, 1.69}));
  EXPECT_TRUE(region.contains({0, 1.71}));
}

TEST(VelocityRegion, AWallForbidsOnlyWhatReachesItInTime) {
  // A wall 1 m ahead, robot radius 0.3: 0.7 m in 2 s.
  const auto region = wallRegion({{-5, 1}, {5, 1}}, 0.3, 2, 1);
  EXPECT_FALSE(region.contains({0, 0.34}));
  EXPECT_TRUE(region.contains({0, 0.36}));
  EXPECT_FALSE(region.contains({1, 0.34}));
  EXPECT_FALSE(region.contains({0, -1}));
  EXPECT_TRUE(wallRegion({{-5, 0.2}, {5, 0.2}}, 0.3, 2, 1).contains({0, -0.09}));  // inside: out in 1 s
  EXPECT_FALSE(wallRegion({{-5, 0.2}, {5, 0.2}}, 0.3, 2, 1).contains({0, -0.11}));
}

TEST(VelocityRegion, OverlappingDiscsAskToSeparate) {
  // Overlap 0.2 m, both standing: half of it in 1 s each.
  const auto region = discRegion(RegionKind::kHrvo, discAt(0.4, 0, 0, 0), {0, 0}, 8, 1);
  EXPECT_TRUE(region.contains({-0.09, 0}));
  EXPECT_FALSE(region.contains({-0.11, 0}));
  // The same place: still a direction, and nothing that is not finite.
  const auto same = discRegion(RegionKind::kHrvo, discAt(0, 0, 0, 0), {0, 0}, 8, 1);
  for (const auto& s : same.sides) EXPECT_TRUE(std::isfinite(s.nx + s.ny + s.c));
}

TEST(VelocityRegion, DoubtAboutVelocityMovesTheLegsOut) {
  DiscView disc = discAt(0, 4, 0, 0);
  disc.velocity_sd = 0.1;
  const auto region = discRegion(RegionKind::kVo, disc, {0, 1}, kForever, 1);
  const double s = 0.6 / 4, c = std::sqrt(1 - s * s);
  // 0.09 and 0.11 outside the left leg of the exact cone.
  EXPECT_TRUE(region.contains(TPoint2D{-s, c} * 0.5 + TPoint2D{-c, -s} * 0.09));
  EXPECT_FALSE(region.contains(TPoint2D{-s, c} * 0.5 + TPoint2D{-c, -s} * 0.11));
}

}  // namespace
}  // namespace sidestep::testing
