// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/distance_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/random.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;
using Cells = std::vector<uint8_t>;

Cells randomCells(Random& random, const GridFrame& f, double share) {
  Cells cells(static_cast<size_t>(f.width) * static_cast<size_t>(f.height));
  for (auto& c : cells) c = random.uniform() < share ? 1 : 0;
  return cells;
}

/// Distance between centres, over all blocked cells and the ring around the raster.
double bruteForce(const GridFrame& f, const Cells& cells, int ix, int iy, double cap) {
  double best = cap;
  for (int y = -1; y <= f.height; ++y)
    for (int x = -1; x <= f.width; ++x) {
      const bool outside = x < 0 || y < 0 || x == f.width || y == f.height;
      if (outside || cells[static_cast<size_t>(y * f.width + x)] != 0)
        best = std::min(best, f.resolution_m * std::hypot(x - ix, y - iy));
    }
  return best;
}

const GridFrame kTurned{40, 25, 0.1, TPose2D(2, -1, 0.7)};

TEST(DistanceField, IsExactAtTheCentresOfCells) {
  Random random(1);
  for (int round = 0; round < 10; ++round) {
    const auto cells = randomCells(random, kTurned, 0.02);
    const DistanceField field(kTurned, cells, {.cap_m = 0.9});
    for (int iy = 0; iy < kTurned.height; ++iy)
      for (int ix = 0; ix < kTurned.width; ++ix) {
        const auto p = kTurned.centre(ix, iy);
        const double expected = bruteForce(kTurned, cells, ix, iy, 0.9);
        EXPECT_NEAR(field.clearance(p.x, p.y), expected, 1e-6) << ix << " " << iy;
        EXPECT_NEAR(field.atCell(ix, iy), expected, 1e-6);
      }
  }
}

TEST(DistanceField, OneObstacleInTheMiddleIsMeasuredBilinearly) {
  Cells cells(25, 0);
  cells[12] = 1;  // cell (2, 2), centre (2.5, 2.5)
  const DistanceField field({5, 5, 1, {}}, cells, {.cap_m = 100});
  EXPECT_DOUBLE_EQ(field.clearance(2.5, 2.5), 0);
  EXPECT_DOUBLE_EQ(field.clearance(3.5, 2.5), 1);
  EXPECT_DOUBLE_EQ(field.clearance(3.0, 2.5), 0.5);
  EXPECT_NEAR(field.clearance(3.0, 3.0), (0 + 1 + 1 + std::sqrt(2)) / 4, 1e-6);
}

TEST(DistanceField, NothingBlockedMeansTheRimIsNearest) {
  const DistanceField field({10, 10, 1, {}}, Cells(100, 0), {.cap_m = 3});
  EXPECT_DOUBLE_EQ(field.clearance(0.5, 5), 1);  // to the ring's centres at x = -0.5
  EXPECT_DOUBLE_EQ(field.clearance(5, 5), 3);    // capped
}

TEST(DistanceField, IsContinuousAtTheRimAndLeadsBackFromOutside) {
  const DistanceField field(kTurned, Cells(1000, 0), {.cap_m = 1});
  const auto at = [&](double x, double y) { return kTurned.T_map_grid.composePoint({x, y}); };
  const auto rim = at(0, 1.2), outside = at(-0.75, 1.2), near = at(-1e-9, 1.2);
  EXPECT_NEAR(field.clearance(rim.x, rim.y), 0.05, 1e-6);
  EXPECT_NEAR(field.clearance(near.x, near.y), 0.05, 1e-6);
  TPoint2D gradient;
  EXPECT_NEAR(field.clearance(outside.x, outside.y, gradient), 0.05 - 0.75, 1e-6);
  EXPECT_NEAR(gradient.x, std::cos(0.7), 1e-6);
  EXPECT_NEAR(gradient.y, std::sin(0.7), 1e-6);
}

TEST(DistanceField, ItsGradientIsThatOfCentralDifferences) {
  Random random(2);
  for (const bool inside : {false, true}) {
    const DistanceField field(kTurned, randomCells(random, kTurned, 0.03), {.cap_m = 2, .negative_inside = inside});
    for (int k = 0; k < 2000; ++k) {
      const double u = random.uniform(-5, 45), v = random.uniform(-5, 30), h = 1e-6;
      const auto away = [](double w) { return std::abs(w - 0.5 - std::round(w - 0.5)); };
      if (away(u) < 1e-3 || away(v) < 1e-3 || std::abs(u) < 1e-3 || std::abs(v) < 1e-3) continue;  // kinks
      const auto p = kTurned.T_map_grid.composePoint({0.1 * u, 0.1 * v});
      TPoint2D g;
      field.clearance(p.x, p.y, g);
      EXPECT_NEAR(g.x, (field.clearance(p.x + h, p.y) - field.clearance(p.x - h, p.y)) / (2 * h), 1e-5);
      EXPECT_NEAR(g.y, (field.clearance(p.x, p.y + h) - field.clearance(p.x, p.y - h)) / (2 * h), 1e-5);
    }
  }
}

TEST(DistanceField, InsideOfObstaclesItCanBeTheWayOut) {
  Cells cells(81, 0);
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 7; ++x) cells[static_cast<size_t>(9 * y + x)] = 1;
  const DistanceField flat({9, 9, 1, {}}, cells), deep({9, 9, 1, {}}, cells, {.negative_inside = true});
  EXPECT_DOUBLE_EQ(flat.clearance(4.5, 4.5), 0);
  EXPECT_DOUBLE_EQ(deep.clearance(4.5, 4.5), -2);  // three cells to the first free centre, one less to the last blocked
  EXPECT_DOUBLE_EQ(deep.clearance(2.5, 4.5), 0);
  EXPECT_DOUBLE_EQ(deep.clearance(1.5, 4.5), 1);
}

TEST(DistanceField, WhatIsNotFiniteFitsNowhere) {
  const DistanceField field({5, 5, 1, {}}, Cells(25, 0));
  const double nan = std::nan("");
  for (const auto& p : {TPoint2D(nan, 1), TPoint2D(1, nan), TPoint2D(INFINITY, 1), TPoint2D(1, -INFINITY)}) {
    TPoint2D g(7, 7);
    EXPECT_EQ(field.clearance(p.x, p.y, g), -INFINITY);
    EXPECT_EQ(g, TPoint2D(0, 0));
    EXPECT_FALSE(field.discFits(p, 0));
    EXPECT_FALSE(field.visible(p, {1, 1}, 0));
    EXPECT_FALSE(field.nearestFree(p, 0.5, 10));
  }
}

TEST(DistanceField, AFrameThatDoesNotFitIsRefused) {
  EXPECT_THROW(DistanceField({5, 5, 1, {}}, Cells(24, 0)), ConfigError);
  EXPECT_THROW(DistanceField({0, 5, 1, {}}, Cells()), ConfigError);
  EXPECT_THROW(DistanceField({5, 5, 0, {}}, Cells(25, 0)), ConfigError);
}

TEST(DistanceField, LowestAlongIsThatOfDenseSampling) {
  Random random(3);
  const DistanceField field(kTurned, randomCells(random, kTurned, 0.01), {.cap_m = 2});
  for (int k = 0; k < 1000; ++k) {
    const auto a = kTurned.T_map_grid.composePoint({random.uniform(0, 4), random.uniform(0, 2.5)});
    const auto b = kTurned.T_map_grid.composePoint({random.uniform(0, 4), random.uniform(0, 2.5)});
    double sampled = 10;
    for (int i = 0; i <= 4000; ++i) {
      const auto p = a + (b - a) * (i / 4000.0);
      sampled = std::min(sampled, field.clearance(p.x, p.y));
    }
    const double exact = field.lowestAlong(a, b, 10);
    EXPECT_LE(exact, sampled + 1e-9);
    EXPECT_GT(exact, sampled - 2e-3);  // 4.7 m / 4000 steps, slope at most sqrt(2)
    EXPECT_EQ(field.visible(a, b, 0.15), field.visible(b, a, 0.15));
    if (std::abs(exact - 0.15) > 1e-6) {
      EXPECT_EQ(field.visible(a, b, 0.15), exact >= 0.15);
    }
  }
}

TEST(DistanceField, AGridLineBesideAWallIsVisible) {
  Cells cells(100, 0);
  for (size_t x = 0; x < 10; ++x) cells[30 + x] = 1;  // row 3
  const DistanceField field({10, 10, 1, {}}, cells);
  EXPECT_TRUE(field.visible({1.5, 4.5}, {8.5, 4.5}, 1.0));
  EXPECT_FALSE(field.visible({1.5, 4.5}, {8.5, 4.49}, 1.0));
  EXPECT_FALSE(field.visible({5, 1}, {5, 8}, 0.1));
}

TEST(DistanceField, APolygonFitsExactlyIfNoBlockedCentreIsWithinTheMargin) {
  Random random(4);
  const std::vector<TPoint2D> shape = {{0.4, 0}, {0.1, 0.25}, {-0.3, 0.2}, {-0.1, 0}, {-0.3, -0.2}};  // not convex
  const auto cells = randomCells(random, kTurned, 0.02);
  const DistanceField field(kTurned, cells);
  int fits = 0, tight = 0;
  for (int k = 0; k < 3000; ++k) {
    const auto p = kTurned.T_map_grid.composePoint({random.uniform(0.6, 3.4), random.uniform(0.6, 1.9)});
    const TPose2D pose(p.x, p.y, random.uniform(-3, 3));
    const double margin = k % 2 == 0 ? 0 : 0.12;
    double nearest = 10;  // of many points of the shape to blocked centres
    for (int iy = 0; iy < kTurned.height; ++iy)
      for (int ix = 0; ix < kTurned.width; ++ix) {
        if (cells[static_cast<size_t>(iy * kTurned.width + ix)] == 0) continue;
        const auto c = pose.inverseComposePoint(kTurned.centre(ix, iy));
        for (size_t i = 0; i < shape.size(); ++i) {
          const auto a = shape[i], b = shape[(i + 1) % shape.size()];
          // Two triangles (tip, corner, notch) make up the shape: points of each side drawn towards the notch.
          for (int s = 0; s <= 20; ++s)
            for (int w = 0; w <= 20; ++w) {
              const auto q = (a + (b - a) * (s / 20.0)) * (w / 20.0) + TPoint2D(-0.1, 0) * (1 - w / 20.0);
              nearest = std::min(nearest, std::hypot(q.x - c.x, q.y - c.y));
            }
        }
      }
    const bool fit = field.polygonFits(shape, pose, margin);
    if (std::abs(nearest - margin) < 0.03) {
      ++tight;
      continue;
    }
    EXPECT_EQ(fit, nearest > margin) << nearest;
    fits += fit;
  }
  EXPECT_GT(fits, 300);
  EXPECT_LT(tight, 2000);
  EXPECT_FALSE(field.polygonFits(shape, kTurned.T_map_grid, 0)) << "leaves the raster";
}

TEST(DistanceField, NearestFreeIsThatOfBruteForce) {
  Random random(5);
  for (int k = 0; k < 200; ++k) {
    const DistanceField field(kTurned, randomCells(random, kTurned, 0.05), {.cap_m = 2});
    const auto from = kTurned.T_map_grid.composePoint({random.uniform(-1, 5), random.uniform(-1, 3.5)});
    const double wanted = 0.35;
    double best = 1e9;
    for (int iy = 0; iy < kTurned.height; ++iy)
      for (int ix = 0; ix < kTurned.width; ++ix)
        if (static_cast<double>(field.atCell(ix, iy)) >= wanted)
          best = std::min(best, (kTurned.centre(ix, iy) - from).norm());
    const auto found = field.nearestFree(from, wanted, 1.5);
    if (field.clearance(from.x, from.y) >= wanted)
      EXPECT_EQ(*found, from);
    else if (best > 1.5)
      EXPECT_FALSE(found);
    else
      EXPECT_NEAR((*found - from).norm(), best, 1e-9);
  }
}

TEST(DistanceField, AnUpdateInAWindowGivesTheFieldBuiltAnew) {
  Random random(6);
  for (const bool inside : {false, true}) {
    auto cells = randomCells(random, kTurned, 0.02);
    DistanceField field(kTurned, cells, {.cap_m = 0.7, .negative_inside = inside});
    for (int k = 0; k < 200; ++k) {
      const CellWindow w{static_cast<int>(random.below(45)) - 5, static_cast<int>(random.below(30)) - 5,
                         static_cast<int>(random.below(45)) - 2, static_cast<int>(random.below(30)) - 2};
      const int columns = std::max(0, w.ix_max - w.ix_min + 1), rows = std::max(0, w.iy_max - w.iy_min + 1);
      Cells change(static_cast<size_t>(columns * rows));
      for (int i = 0; i < columns * rows; ++i) {
        const int ix = w.ix_min + i % columns, iy = w.iy_min + i / columns;
        const bool in = ix >= 0 && iy >= 0 && ix < kTurned.width && iy < kTurned.height;
        uint8_t none = 0, &cell = in ? cells[static_cast<size_t>(iy * kTurned.width + ix)] : none;
        const bool flips = random.uniform() < 0.02;
        if (k % 2 == 0) cell = cell != 0 || flips;  // only appearing
        if (k % 2 == 1) cell = (cell != 0) != flips;
        change[static_cast<size_t>(i)] = cell;
      }
      field.update(w, change);
      const DistanceField anew(kTurned, cells, {.cap_m = 0.7, .negative_inside = inside});
      for (int iy = 0; iy < kTurned.height; ++iy)
        for (int ix = 0; ix < kTurned.width; ++ix) ASSERT_EQ(field.atCell(ix, iy), anew.atCell(ix, iy)) << k;
    }
  }
}

}  // namespace
}  // namespace sidestep
