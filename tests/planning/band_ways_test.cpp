// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Ways that are timed among what moves, islands of a map, robots longer than wide.
#include <gtest/gtest.h>

#include "core/random.h"
#include "planning/band/band_planner.h"
#include "support/jacobian.h"

namespace sidestep {
namespace {

MovingObstacle walker(double x, double y, double vx, double vy) {
  MovingObstacle o;
  o.position = {x, y};
  o.velocity = {vx, vy};
  return o;
}

/// A straight way of 8 m from the origin, with 1 m behind it, among walkers.
struct StraightWay {
  explicit StraightWay(std::vector<MovingObstacle> walkers) : moving(std::move(walkers)) {
    MovingView in_time;
    in_time.kind = MovingView::Kind::kInTime;
    in_time.horizon_s = 30;
    view.build({{}, {}, moving, nullptr}, in_time, {-5, -10, 15, 10}, 0.8);
    query.obstacles = &view;
    query.keep_out_m = 0.5;
    const double cell = WayTiming::spacing(query.limits);
    start = static_cast<int>(std::lround(1 / cell));
    for (int i = -start; i <= std::lround(8 / cell); ++i) points.push_back({i * cell, 0});
  }
  bool search() { return timing.search(points, start, query); }

  std::vector<MovingObstacle> moving;
  ObstacleView view;
  WayTiming::Query query;
  std::vector<mrpt::math::TPoint2D> points;
  int start = 0;
  WayTiming timing;
};

TEST(WayTiming, AloneItIsAsQuickAsTheStraightDriveAndInsideTheLimits) {
  StraightWay way({});
  ASSERT_TRUE(way.search());
  // 8 m at 1 m/s and 0.5 m/s^2 take 10 s; its speeds are five of 0.2 m/s, one more every half second: 0.4 m/s^2, so
  // 2.5 s up and down again, over 1.25 m each, and 5.5 m at full speed: 10.5 s
  EXPECT_NEAR(way.timing.duration(), 10.5, 1e-9);
  EXPECT_NEAR(way.timing.wayAt(0), 0, 1e-12);
  EXPECT_NEAR(way.timing.wayAt(way.timing.duration()), 8, 1e-9);
  const double dt = 0.01;
  for (double t = dt; t + dt < way.timing.duration(); t += dt) {
    const double before = way.timing.wayAt(t - dt), here = way.timing.wayAt(t), after = way.timing.wayAt(t + dt);
    ASSERT_LE((after - here) / dt, 1 + 1e-9) << t;
    ASSERT_LE(std::abs(after - 2 * here + before) / (dt * dt), 0.5 + 1e-6) << t;
  }
}

TEST(WayTiming, ItWaitsForAColumnOfWalkersAndKeepsClearOfEach) {
  std::vector<MovingObstacle> column;
  for (int i = 0; i < 12; ++i) column.push_back(walker(3, -2 - 0.7 * i, 0, 0.7));  // one a second, the last at 14 s
  StraightWay way(column);
  ASSERT_TRUE(way.search());
  EXPECT_GT(way.timing.duration(), 14 + 3);  // from 3 m it takes more than 3 s to rest at 8 m
  for (double t = 0; t < way.timing.duration(); t += 0.25)
    for (const auto& o : way.moving)
      EXPECT_GE(std::hypot(way.timing.wayAt(t) - o.position.x, o.position.y + t * 0.7) - o.radius_m, 0.5 - 0.06) << t;
}

TEST(WayTiming, ItBacksOffFromAWalkerWhoCrossesWhereItStands) {
  // a wall of people crosses the way ahead until 12 s, while one walks over the start at 4 s
  std::vector<MovingObstacle> people = {walker(0.55, -2, 0, 0.5)};
  for (int i = 0; i < 20; ++i) people.push_back(walker(1.2, 2 - 0.5 * i, 0, 0.5));
  StraightWay way(people);
  ASSERT_TRUE(way.search());
  double least = 0;
  for (double t = 0; t < way.timing.duration(); t += 0.1) least = std::min(least, way.timing.wayAt(t));
  EXPECT_LT(least, -0.1);
}

TEST(WayTiming, WhereSomebodyStandsOnTheWayThereIsNoTime) {
  StraightWay way({walker(4, 0, 0, 0)});
  EXPECT_FALSE(way.search());
}

TEST(SpaceTimeSearch, ItsDrivesKeepClearAndToTheAccelerations) {
  // 60 points that go any way at up to 0.7 m/s
  Random random(4);
  std::vector<MovingObstacle> people;
  for (int i = 0; i < 60; ++i) {
    people.push_back(walker(random.uniform(1, 7), random.uniform(-3, 3), random.uniform(-0.5, 0.5), 0));
    people.back().velocity.y = random.uniform(-0.5, 0.5);
    people.back().radius_m = 0;
  }
  MovingView in_time;
  in_time.kind = MovingView::Kind::kInTime;
  in_time.horizon_s = 30;
  ObstacleView view;
  const GridBounds bounds{-5, -8, 13, 8};
  view.build({{}, {}, people, nullptr}, in_time, bounds, 0.8);
  SpaceTimeSearch search;
  SpaceTimeSearch::Query query;
  query.goal = {8, 0};
  query.keep_out_m = 0.35;
  query.bounds = bounds;
  query.obstacles = &view;
  Band band;
  ASSERT_TRUE(search.search(query, band, [](const Band&) { return true; }));
  EXPECT_EQ(band.back().x, 8);
  for (double t = 0; t < band.back().t; t += 0.05)
    for (const auto& o : people) {
      const BandPose p = bandAt(band, t);
      // looks 0.25 s apart at up to 1.7 m/s: sqrt(0.35^2 - 0.21^2) = 0.28; half a pixel of the map: 0.035
      EXPECT_GE(std::hypot(p.x - o.position.x - t * o.velocity.x, p.y - o.position.y - t * o.velocity.y), 0.245) << t;
    }
  const BandPose before_end = bandAt(band, band.back().t - 3);  // the straight end has a bend of its own
  while (band.back().t > before_end.t) band.pop_back();
  const BandExtremes most = extremesOf(band, {0, 0, false});
  EXPECT_LE(most.v, 1.001);
  EXPECT_LE(most.a, 0.501);
  EXPECT_LE(most.turn_accel, 0.501);
}

TEST(SpaceTimeSearch, WhereThereIsNoWayItSaysSoWithinItsWork) {
  const std::vector<Segment> walls = {{{3, -9}, {3, 9}}};
  ObstacleView view;
  const GridBounds bounds{-5, -8, 13, 8};
  view.build({{}, walls, {}, nullptr}, {}, bounds, 0.8);
  SpaceTimeSearch search;
  SpaceTimeSearch::Query query;
  query.goal = {8, 0};
  query.bounds = bounds;
  query.obstacles = &view;
  query.work_max = 5000;
  Band band;
  EXPECT_FALSE(search.search(query, band, [](const Band&) { return true; }));
  EXPECT_LE(search.work(), 5000u + 1000u);
}

TEST(BandPlanner, WhereEveryBandMeetsSomebodyItLetsThemPass) {
  // a procession as wide as the graph reaches, crossing for 20 s: there is no way but to wait
  std::vector<MovingObstacle> people;
  for (int i = 0; i < 60; ++i)
    for (double x : {3.0, 4.0}) people.push_back(walker(x, 8 - 0.5 * i, 0, 1));
  for (auto& o : people) o.id = static_cast<int>(&o - people.data());
  PlanInput in;
  in.goal = {8, 0, 0};
  in.moving = people;
  BandPlanner planner(bandPlannerParams("eteb"));
  PlanOutput out;
  planner.plan(in, out);
  ASSERT_NE(planner.chosen(), nullptr);
  EXPECT_TRUE(planner.chosen()->whole.clear);
  EXPECT_GT(planner.chosen()->band.back().t, 20);
}

/// A room of 16 m x 12 m with a block between start and goal, which the field alone shows.
DistanceField blockInTheMiddle() {
  GridFrame frame;
  frame.width = 160;
  frame.height = 120;
  frame.resolution_m = 0.1;
  frame.T_map_grid = {-4, -6, 0};
  std::vector<uint8_t> blocked(160 * 120);
  for (size_t y = 55; y < 65; ++y)
    for (size_t x = 75; x < 85; ++x) blocked[y * 160 + x] = 1;  // 3.5..4.5 m, -0.5..0.5 m
  return DistanceField(frame, blocked);
}

TEST(FieldIslands, ABlockIsOnePointInsideOfIt) {
  const DistanceField field = blockInTheMiddle();
  FieldIslands islands;
  islands.find(&field, GoalFrame(0, 0, 8, 0), 4, 0.3);
  ASSERT_EQ(islands.points().size(), 1u);
  EXPECT_LT(field.clearance(islands.points()[0].x, islands.points()[0].y), 0.15);
}

TEST(FieldIslands, TwoBlocksThatTheRobotFitsBetweenAreTwo) {
  GridFrame frame;
  frame.width = frame.height = 100;
  frame.resolution_m = 0.1;
  frame.T_map_grid = {-1, -5, 0};
  for (size_t shift = 0; shift < 10; ++shift) {
    std::vector<uint8_t> blocked(100 * 100);
    for (size_t i = 0; i < 25; ++i) {
      blocked[(40 + shift + i / 5) * 100 + 40 + i % 5] = 1;
      blocked[(52 + shift + i / 5) * 100 + 40 + i % 5] = 1;  // 0.8 m between the nearest centres
    }
    const DistanceField field(frame, blocked);
    FieldIslands islands;
    islands.find(&field, GoalFrame(0, 0, 8, 0), 4, 0.3);
    EXPECT_EQ(islands.points().size(), 2u) << shift;
  }
}

TEST(BandPlanner, TwoSidesOfABlockOfTheMapAreTwoClasses) {
  const DistanceField field = blockInTheMiddle();
  PlanInput in;
  in.goal = {8, 0.1, 0};
  in.field = &field;
  BandPlanner planner(bandPlannerParams("teb"));
  PlanOutput out;
  planner.plan(in, out);
  std::set<uint64_t> classes;
  bool left = false, right = false;
  for (const auto& c : planner.candidates()) {
    if (!c.alive) continue;
    classes.insert(c.signature);
    (bandAt(c.band, c.band.back().t / 2).y > 0 ? left : right) = true;
  }
  EXPECT_EQ(classes.size(), 2u);
  EXPECT_TRUE(left && right);
}

TEST(Footprint, TheDiscsHoldTheWholeRectangle) {
  for (const FootprintParams& p : {FootprintParams{1.2, 0.5, 0.2}, FootprintParams{0.6, 0.6, 0}, {3, 0.4, -0.3}}) {
    const Footprint robot(p, 0.3);
    for (double x = -p.length_m / 2; x <= p.length_m / 2 + 1e-9; x += p.length_m / 50)
      for (double y : {-p.width_m / 2, 0.0, p.width_m / 2}) {
        double deepest = 1e9;
        for (int i = 0; i < robot.discs; ++i)
          deepest = std::min(deepest, std::hypot(x + p.ahead_m - robot.along(i), y) - robot.radius_m);
        EXPECT_LE(deepest, 1e-9) << x << " " << y;
      }
  }
  EXPECT_TRUE(Footprint(FootprintParams{}, 0.25).isDisc());
}

TEST(Footprint, ClearanceOfALongRobotHasTheDerivativesItSays) {
  const std::vector<mrpt::math::TPoint2D> points = {{0.9, 0.6}, {-0.8, 0.3}};
  ObstacleView obstacles;
  obstacles.build({points, {}, {}, nullptr}, {}, {-3, -3, 3, 3}, 0.9);
  const ClearanceCost cost{Footprint(FootprintParams{1.2, 0.5, 0.1}, 0.3), 0.5, 0.4};
  const auto residuals = [&](const Eigen::VectorXd& x) {
    std::vector<double> r;
    cost.evaluate({x(0), x(1), x(2), 0}, obstacles, [&](double v, const PoseGradient&) { r.push_back(v); });
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size())));
  };
  const Eigen::Vector3d at(0.1, 0.05, 0.4);
  const Eigen::MatrixXd J = support::centralDifferences(residuals, Eigen::VectorXd(at));
  Eigen::Index k = 0;
  cost.evaluate({at(0), at(1), at(2), 0}, obstacles, [&](double, const PoseGradient& g) {
    EXPECT_LT((J.row(k++).transpose() - Eigen::Vector3d(g.x, g.y, g.theta)).cwiseAbs().maxCoeff(), 1e-6);
  });
  EXPECT_GE(k, 3);
}

TEST(Footprint, ALongRobotIsCheckedWithItsFrontWhereADiscWouldPass) {
  // a wall 0.55 m ahead of a robot that turns on the spot beside it: the disc of 0.3 m is clear, the front is not
  const std::vector<Segment> walls = {{{-2, 0.55}, {2, 0.55}}};
  ObstacleView obstacles;
  obstacles.build({{}, walls, {}, nullptr}, {}, {-5, -5, 5, 5}, 1.2);
  Band turn;
  for (int i = 0; i <= 10; ++i) turn.push_back({0, 0, 0.15 * i, 0.5 * i});
  EXPECT_TRUE(checkWhole(turn, Footprint(0.3), obstacles).clear);
  EXPECT_FALSE(checkWhole(turn, Footprint(FootprintParams{1.2, 0.4, 0}, 0.3), obstacles).clear);
}

}  // namespace
}  // namespace sidestep
