// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/grid_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>

#include "planning/global/any_angle_planner.h"
#include "support/grid_worlds.h"

namespace sidestep::testing {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Dijkstra's algorithm out of the textbook, on free cells found from the distance field alone. A diagonal move needs
/// the two cells beside it, a knight's move the six cells of the two squares it crosses.
class Textbook {
 public:
  Textbook(const GridWorld& world, const DistanceField& field, double clearance, int neighbours, double weight,
           double comfort)
      : w_(world.frame.width), h_(world.frame.height), neighbours_(neighbours) {
    for (int y = 0; y < h_; ++y)
      for (int x = 0; x < w_; ++x) {
        const double d = static_cast<double>(field.atCell(x, y)), lack = (comfort - d) / (comfort - clearance);
        free_.push_back(d >= clearance);
        price_.push_back(lack > 0 ? weight * lack * lack : 0);
      }
  }
  bool free(int x, int y) const { return x >= 0 && y >= 0 && x < w_ && y < h_ && free_[at(x, y)]; }

  /// In cells; infinity if there is no way.
  double cost(int x0, int y0, int x1, int y1) const {
    std::vector<double> best(free_.size(), INFINITY);
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
    best[at(x0, y0)] = 0;
    open.push({0, y0 * w_ + x0});
    while (!open.empty()) {
      const auto [g, i] = open.top();
      open.pop();
      const int x = i % w_, y = i / w_;
      if (x == x1 && y == y1) return g;
      if (g > best[static_cast<size_t>(i)]) continue;
      for (int dx = -2; dx <= 2; ++dx)
        for (int dy = -2; dy <= 2; ++dy) {
          if (!allowed(x, y, dx, dy)) continue;
          const size_t j = at(x + dx, y + dy);
          const double now = g + std::hypot(dx, dy) * (1 + (price_[static_cast<size_t>(i)] + price_[j]) / 2);
          if (now < best[j]) best[j] = now, open.push({now, static_cast<int>(j)});
        }
    }
    return INFINITY;
  }

 private:
  size_t at(int x, int y) const { return static_cast<size_t>(y * w_ + x); }
  bool allowed(int x, int y, int dx, int dy) const {
    const int a = std::max(std::abs(dx), std::abs(dy)), b = std::min(std::abs(dx), std::abs(dy));
    if (a == 0 || (a == 2 && (b != 1 || neighbours_ == 8))) return false;
    for (int ix = std::min(0, dx); ix <= std::max(0, dx); ++ix)
      for (int iy = std::min(0, dy); iy <= std::max(0, dy); ++iy)
        if (!free(x + ix, y + iy)) return false;
    return true;
  }
  int w_, h_, neighbours_;
  std::vector<bool> free_;
  std::vector<double> price_;
};

struct Problem {
  GridWorld world;
  int x0, y0, x1, y1;
  TPose2D start() const { return pose(x0, y0); }
  TPose2D goal() const { return pose(x1, y1); }
  TPose2D pose(int x, int y) const {
    const auto p = world.frame.centre(x, y);
    return {p.x, p.y, 0};
  }
};

constexpr double kClearance = 0.2;

Problem randomProblem(Random& random) {
  Problem p{randomWorld(random), 0, 0, 0, 0};
  const auto w = static_cast<uint64_t>(p.world.frame.width), h = static_cast<uint64_t>(p.world.frame.height);
  const auto field = p.world.field();
  for (int tries = 0; tries < 30; ++tries) {  // most of the time both are free cells
    if (tries == 0 || static_cast<double>(field->atCell(p.x0, p.y0)) < kClearance)
      p.x0 = static_cast<int>(random.below(w)), p.y0 = static_cast<int>(random.below(h));
    if (tries == 0 || static_cast<double>(field->atCell(p.x1, p.y1)) < kClearance)
      p.x1 = static_cast<int>(random.below(w)), p.y1 = static_cast<int>(random.below(h));
  }
  return p;
}

/// Distance to the nearest centre of a blocked cell, measured without the field.
double trueClearance(const GridWorld& world, double x, double y) {
  double best = 1e9;
  for (int iy = -1; iy <= world.frame.height; ++iy)
    for (int ix = -1; ix <= world.frame.width; ++ix) {
      const bool outside = ix < 0 || iy < 0 || ix == world.frame.width || iy == world.frame.height;
      if (!outside && world.blocked[static_cast<size_t>(iy * world.frame.width + ix)] == 0) continue;
      const auto c = world.frame.centre(ix, iy);
      best = std::min(best, std::hypot(c.x - x, c.y - y));
    }
  return best;
}

/// At a quarter of a cell. Interpolation lies above the distance to a point by at most h^2 / 8 times its Laplacian 1 /
/// d: with h = 0.1 and d >= 0.2 - 0.1 sqrt(2) that is 0.0214.
void expectItTouchesNothing(const GridWorld& world, const DistanceField& field, const std::vector<TPose2D>& poses,
                            bool measure) {
  for (size_t i = 1; i < poses.size(); ++i) {
    const TPoint2D a(poses[i - 1].x, poses[i - 1].y), b(poses[i].x, poses[i].y);
    const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / (world.frame.resolution_m / 4))));
    for (int k = 0; k <= n; ++k) {
      const auto p = a + (b - a) * (static_cast<double>(k) / n);
      ASSERT_GE(field.clearance(p.x, p.y), kClearance - 1e-6);
      if (measure) {
        ASSERT_GE(trueClearance(world, p.x, p.y), kClearance - 0.0214);
      }
    }
  }
}

TEST(GridSearch, AStarCostsWhatDijkstraDoesOnAThousandRandomProblems) {
  Random random(1);
  int found = 0;
  for (int k = 0; found < 1000; ++k) {
    ASSERT_LT(k, 4000);
    const Problem p = randomProblem(random);
    const auto field = p.world.field();
    const auto grid = std::make_shared<const PlanningGrid>(field, kClearance);
    const GridSearchParams params{k % 4 == 3 ? 16 : 8, k % 4 == 2 ? 3.0 : 0.0, 0.6};
    const Textbook textbook(p.world, *field, kClearance, params.neighbours, params.clearance_weight, params.comfort_m);
    GridPlanner astar(grid, params, true), dijkstra(grid, params, false);
    const auto a = astar.plan(p.start(), p.goal()), d = dijkstra.plan(p.start(), p.goal());
    const double cost = textbook.free(p.x0, p.y0) && textbook.free(p.x1, p.y1)
                            ? 0.1 * textbook.cost(p.x0, p.y0, p.x1, p.y1)
                            : std::numeric_limits<double>::infinity();
    ASSERT_EQ(a.found(), std::isfinite(cost)) << k << " " << a.reason;
    ASSERT_EQ(a.status, d.status);
    if (!a.found()) continue;
    ++found;
    ASSERT_EQ(a.cost, d.cost) << k;
    // 2203 for 985 sqrt(5) is 0.022 % too much; a price is a multiple of 1/512, its product rounded down to a whole.
    ASSERT_NEAR(a.cost, cost, params.clearance_weight > 0 ? 4e-3 * cost : 2.2e-4 * cost + 1e-9) << k;
    ASSERT_LE(a.expanded, d.expanded);
    expectItTouchesNothing(p.world, *field, a.poses, k % 20 == 0);
    expectItTouchesNothing(p.world, *field, d.poses, false);
  }
}

TEST(GridSearch, AnyAnglePathsAreNeverLongerThanAStarAndTouchNothing) {
  Random random(2);
  int found = 0;
  double shorter = 0;
  for (int k = 0; found < 1000; ++k) {
    ASSERT_LT(k, 4000);
    const Problem p = randomProblem(random);
    const auto field = p.world.field();
    const auto grid = std::make_shared<const PlanningGrid>(field, kClearance);
    AnyAnglePlanner theta(grid, {});
    GridPlanner astar(grid, {}, true);
    // Anywhere in the cell, not only at its centre.
    auto start = p.start(), goal = p.goal();
    start.x += random.uniform(-0.03, 0.03), goal.y += random.uniform(-0.03, 0.03);
    const auto t = theta.plan(start, goal), a = astar.plan(start, goal);
    ASSERT_EQ(t.status, a.status);
    if (!t.found()) continue;
    ++found;
    const double length = pathLength(a.poses);
    ASSERT_LE(pathLength(t.poses), length * (1 + 1e-9)) << k;
    shorter += pathLength(t.poses) < 0.99 * length;
    ASSERT_NEAR(t.cost, pathLength(t.poses), 1e-9);
    EXPECT_EQ(t.poses.front().x, start.x);
    EXPECT_EQ(t.poses.back().y, goal.y);
    expectItTouchesNothing(p.world, *field, t.poses, k % 20 == 0);
  }
  EXPECT_GT(shorter, found / 2);
}

TEST(GridSearch, AcrossOpenGroundLengthsAreThoseOfTheMoves) {
  const GridWorld world = drawn(std::vector<std::string>(40, std::string(60, '.')), 0.1);
  const auto grid = std::make_shared<const PlanningGrid>(world.field(), 0.15);
  // 30 cells in x, 10 in y: 20 straight + 10 diagonal; or 10 knight's moves (20, 10) + 10 straight; or sqrt(10) * 10.
  const TPose2D start(1.05, 1.05, 0), goal(4.05, 2.05, 0.5);
  GridPlanner eight(grid, {8, 0, 1}, true), sixteen(grid, {16, 0, 1}, true);
  AnyAnglePlanner any(grid, {});
  EXPECT_NEAR(pathLength(eight.plan(start, goal).poses), 2 + std::sqrt(2), 1e-9);
  EXPECT_NEAR(pathLength(sixteen.plan(start, goal).poses), 1 + std::sqrt(5), 1e-9);
  const auto straight = any.plan(start, goal);
  ASSERT_EQ(straight.poses.size(), 2u);
  EXPECT_NEAR(straight.cost, std::sqrt(10), 1e-9);
  EXPECT_NEAR(straight.poses[0].phi, std::atan2(1, 3), 1e-9);
  EXPECT_EQ(straight.poses[1].phi, 0.5);
}

TEST(GridSearch, RoundADiscAnyAngleIsTwoTangentsAndAnArc) {
  const int n = 400;
  GridWorld world{{n, n, 0.05, {}}, std::vector<uint8_t>(n * n, 0)};
  world.blocked[200 * n + 200] = 1;  // centre (10.025, 10.025)
  const double r = 2, half = 4;
  AnyAnglePlanner any(std::make_shared<const PlanningGrid>(world.field({.cap_m = 10}), r), {});
  const auto path = any.plan({10.025 - half, 10.025, 0}, {10.025 + half, 10.025, 0});
  ASSERT_TRUE(path.found());
  // Tangent sqrt(4^2 - 2^2) = 3.4641 twice, arc 2 * (pi - 2 acos(2/4)) = 2 * 1.0472: 9.0226 m.
  const double expected = 2 * std::sqrt(half * half - r * r) + r * (M_PI - 2 * std::acos(r / half));
  EXPECT_GT(path.cost, expected - 1e-3);
  EXPECT_LT(path.cost, expected * 1.001);
}

TEST(GridSearch, APriceOnTightPlacesBuysClearance) {
  // A short gap of 5 cells, and a wide way round it.
  std::vector<std::string> lines(60, std::string(60, '.'));
  for (int row = 30; row < 60; ++row) lines[static_cast<size_t>(row)][30] = row >= 40 && row < 45 ? '.' : '#';
  const auto field = drawn(lines, 0.1).field();
  const auto grid = std::make_shared<const PlanningGrid>(field, 0.2);
  GridPlanner cheap(grid, {8, 0, 1}, true), dear(grid, {8, 10, 1}, true);
  const TPose2D start(1.55, 1.75, 0), goal(4.55, 1.75, 0);
  const auto tight = cheap.plan(start, goal), wide = dear.plan(start, goal);
  const auto highest = [](const GlobalPath& p) {
    return std::max_element(p.poses.begin(), p.poses.end(), [](auto& a, auto& b) { return a.y < b.y; })->y;
  };
  EXPECT_LT(highest(tight), 2);
  EXPECT_GT(highest(wide), 3.1);  // over the end of the wall at row 30 from above, y = 3
}

TEST(GridSearch, TheSameQueryGivesTheSamePathWhateverWasAskedBefore) {
  Random random(3);
  const Problem p = [&] {
    for (;;) {
      const Problem q = randomProblem(random);
      const auto grid = std::make_shared<const PlanningGrid>(q.world.field(), kClearance);
      if (GridPlanner(grid, {}, true).plan(q.start(), q.goal()).expanded > 100) return q;
    }
  }();
  const auto grid = std::make_shared<const PlanningGrid>(p.world.field(), kClearance);
  GridPlanner one(grid, {}, true), other(grid, {}, true);
  const auto first = one.plan(p.start(), p.goal());
  for (int k = 0; k < 50; ++k) {
    const auto q = p.pose(static_cast<int>(random.below(20)), static_cast<int>(random.below(20)));
    other.plan(q, p.goal());
  }
  const auto again = other.plan(p.start(), p.goal());
  ASSERT_EQ(first.poses.size(), again.poses.size());
  for (size_t i = 0; i < first.poses.size(); ++i) EXPECT_EQ(first.poses[i], again.poses[i]);
}

TEST(GridSearch, SaysWhyThereIsNoPath) {
  const GridWorld world =
      drawn({"..........", "..........", "..........", "##########", "..........", "..........", ".........."}, 0.5);
  const auto grid = std::make_shared<const PlanningGrid>(world.field(), 0.6);
  GridPlanner planner(grid, {}, true);
  using Status = GlobalPath::Status;
  const TPose2D low(2, 0.75, 0), high(2, 2.75, 0);
  EXPECT_EQ(planner.plan(low, high).status, Status::kUnreachable);
  EXPECT_EQ(planner.plan(low, high).reason,
            "the goal (2.00, 2.75) cannot be reached from (2.00, 0.75) with a clearance of 0.60 m");
  EXPECT_EQ(planner.plan({-1, 0, 0}, high).status, Status::kStartOutside);
  EXPECT_EQ(planner.plan({-1, 0, 0}, high).reason, "the start (-1.00, 0.00) lies outside of the map");
  EXPECT_EQ(planner.plan(low, {2, 99, 0}).status, Status::kGoalOutside);
  EXPECT_EQ(planner.plan({2, 1.75, 0}, low).status, Status::kStartBlocked);
  EXPECT_EQ(planner.plan(low, {2, 1.75, 0}).reason,
            "the goal (2.00, 1.75) is 0.00 m from an obstacle, less than 0.60 m");
  EXPECT_EQ(planner.plan({std::nan(""), 0, 0}, high).status, Status::kStartOutside);
}

TEST(GridSearch, AStartThatIsTheGoalIsAPathOfOnePose) {
  const GridWorld world = drawn(std::vector<std::string>(9, std::string(9, '.')), 0.5);
  GridPlanner planner(std::make_shared<const PlanningGrid>(world.field(), 0.6), {}, true);
  const auto path = planner.plan({2.25, 2.25, 0}, {2.25, 2.25, 1});
  ASSERT_TRUE(path.found());
  ASSERT_EQ(path.poses.size(), 1u);
  EXPECT_EQ(path.poses[0].phi, 1);
  EXPECT_EQ(path.cost, 0);
}

TEST(BucketQueue, GivesWhatASortedListDoesAndTheLastOfEqualsFirst) {
  Random random(4);
  BucketQueue queue;
  for (int round = 0; round < 20; ++round) {
    std::map<uint32_t, std::vector<uint32_t>> expected;
    uint32_t now = static_cast<uint32_t>(random.below(1u << 30));
    queue.clear(now);
    for (uint32_t k = 0; k < 5000; ++k) {
      if (expected.empty() || random.uniform() < 0.6) {
        const auto spread = random.uniform() < 0.9 ? 50u : BucketQueue::kRange;
        const uint32_t key = now + static_cast<uint32_t>(random.below(spread));
        queue.push(key, k);
        expected[key].push_back(k);
        continue;
      }
      const auto entry = queue.pop();
      auto& lowest = *expected.begin();
      ASSERT_EQ(entry.key, lowest.first);
      ASSERT_EQ(entry.value, lowest.second.back());
      lowest.second.pop_back();
      now = entry.key;
      if (lowest.second.empty()) expected.erase(expected.begin());
    }
    EXPECT_EQ(queue.empty(), expected.empty());
  }
}

}  // namespace
}  // namespace sidestep::testing
