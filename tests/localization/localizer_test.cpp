// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/localizer.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationBeaconRanges.h>

#include <algorithm>
#include <limits>
#include <random>

#include "localization/filters/ekf.h"
#include "localization/pose_filter.h"
#include "localization/sensors/beacons.h"
#include "localization/sensors/gps.h"
#include "support/readings.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;
using support::kStart_s;
constexpr double kDegree = M_PI / 180;

LocalizerParams fromOrigin() {
  LocalizerParams p;
  p.start.pose_given = true;
  p.of<GpsParams>().sd_m = 0.5;
  return p;
}

/// A localizer with one stream of each kind; seconds count from the start of the log.
struct Robot {
  explicit Robot(const LocalizerParams& params = fromOrigin(), const Expectation& expect = {},
                 const EkfParams& ekf = {}, bool joins_instants = false)
      : filter(makeEkf(ekf)), view(filter.get()), localizer(params, std::move(filter), {expect, {}, joins_instants}) {}

  template <class Observation>
  void tell(SensorKind kind, double t, Observation o) {
    localizer.observe(support::readingOf(kind, kStart_s + t, std::move(o)));
  }
  void wheels(double t, const TPose2D& pose) { localizer.observe(support::wheelsAt(kStart_s + t, pose)); }
  void speeds(double t, double v, double w) { tell(SensorKind::kOdometry, t, support::velocityAt(t, v, w)); }
  void fix(double t, double x, double y) { localizer.observe(support::positionAt(kStart_s + t, x, y)); }
  void yaw(double t, double angle) { tell(SensorKind::kImu, t, support::yaw(angle)); }
  void yawRate(double t, double rate) { tell(SensorKind::kImu, t, support::yawRate(rate)); }
  /// Odometry at 10 Hz along the circle of 10 m, after `from` up to `to` seconds.
  void drive(double from, double to) {
    for (int i = static_cast<int>(std::lround(10 * from)) + 1; i <= std::lround(10 * to); ++i)
      wheels(0.1 * i, support::onCircle(1, 0.1, 0.1 * i));
  }
  std::vector<Estimate> finish() {
    localizer.finish();
    return localizer.takeEstimates();
  }
  bool started() {
    localizer.completeInstant();
    return localizer.started();
  }
  const SensorUse& gps() {
    localizer.completeInstant();
    for (const auto& s : localizer.sensors())
      if (s.kind == SensorKind::kGps) return s;
    throw std::logic_error("no fix was told");
  }

  std::unique_ptr<PoseFilter> filter;
  PoseFilter* view;  // the localizer's own
  Localizer localizer;
};

void expectEqual(const PoseBelief& a, const PoseBelief& b) {
  EXPECT_NEAR(a.mean.x, b.mean.x, 1e-9);
  EXPECT_NEAR(a.mean.y, b.mean.y, 1e-9);
  EXPECT_NEAR(a.mean.phi, b.mean.phi, 1e-9);
  EXPECT_LT((a.covariance - b.covariance).cwiseAbs().maxCoeff(), 1e-9);
}

bool finite(const PoseBelief& b) {
  return std::isfinite(b.mean.x) && std::isfinite(b.mean.y) && std::isfinite(b.mean.phi) && b.covariance.allFinite();
}

TEST(Localizer, AFixAndAHeadingOfOneInstantAreTheSameByPartsAndAtOnce) {
  // (3.14); to a Kalman filter whose linear measurements come at one pose it makes no difference.
  auto params = fromOrigin();
  params.start.position_sd_m = 1;
  params.start.yaw_sd = 0.2;
  EkfParams ekf;
  ekf.gate = false;
  Robot parts(params, {}, ekf), at_once(params, {}, ekf, true);
  for (auto* r : {&parts, &at_once}) {
    r->wheels(0, {});
    r->drive(0, 1);
  }
  for (auto* r : {&parts, &at_once}) {
    r->yaw(1, 0.15);
    r->fix(1, 1.2, 0.1);
  }
  expectEqual(parts.finish().back().belief, at_once.finish().back().belief);
  EXPECT_EQ(at_once.gps().nis_dof, 3);
}

TEST(Localizer, RecordsEachInnovationOnceWhenAskedTo) {
  Robot silent, robot;
  robot.localizer.recordMore(0);
  for (auto* r : {&silent, &robot}) {
    r->wheels(0, {});
    r->drive(0, 1);
    r->fix(0.75, 0.7, 0.1);  // late: what followed is played again
    r->fix(0.35, 0.3, 0.1);
    r->finish();
  }
  EXPECT_TRUE(silent.localizer.takeInnovations().empty());
  const auto records = robot.localizer.takeInnovations();
  ASSERT_EQ(records.size(), 2u);
  EXPECT_NEAR(records[0].time_s - kStart_s, 0.75, 1e-6);
  EXPECT_EQ(robot.localizer.sensors()[static_cast<size_t>(records[0].stream)].kind, SensorKind::kGps);
  EXPECT_EQ(records[0].dof, 2);
  EXPECT_TRUE(records[0].accepted);
}

// ---- measurements in time ----

TEST(Localizer, PutsAFixBetweenTwoOdometryReadings) {
  Robot robot;
  robot.speeds(0, 1, 0);
  robot.fix(0.25, 0.6, 0.1);
  robot.speeds(1, 1, 0);
  const auto last = robot.finish().back();
  // The same by hand: a quarter of the step, the fix, the rest.
  MotionStep step;
  step.dt_s = step.distance_m = 1;
  MotionNoiseParams().apply(step);
  Ekf<3> ekf({});
  PoseBelief origin;
  origin.covariance.diagonal() << 0.05 * 0.05, 0.05 * 0.05, 0.02 * 0.02;
  ekf.start(origin);
  ekf.predict(step.part(0.25));
  Measurement m;
  m.z << 0.6, 0.1, 0;
  m.R(0, 0) = m.R(1, 1) = 0.25;
  EXPECT_TRUE(ekf.correct(m).accepted());
  ekf.predict(step.part(0.75));
  expectEqual(last.belief, ekf.estimate());
  EXPECT_NEAR(last.time_s, kStart_s + 1, 1e-9);
}

TEST(Localizer, GivesTheSameForALateFixAsForOneInTime) {
  Robot in_time, late;
  for (Robot* r : {&in_time, &late}) r->wheels(0, {0, 0, 0});
  in_time.drive(0, 3);
  in_time.fix(3.03, 3, 0.8);
  in_time.drive(3, 5);
  late.drive(0, 4.5);
  late.fix(3.03, 3, 0.8);
  late.drive(4.5, 5);
  EXPECT_EQ(late.gps().used, 1u);
  expectEqual(in_time.finish().back().belief, late.finish().back().belief);
}

TEST(Localizer, GivesTheSameForFixesInAnyOrder) {
  std::vector<double> times = {3.01, 3.12, 3.25, 3.25001, 3.4};
  std::optional<PoseBelief> first;
  do {
    Robot robot;
    robot.wheels(0, {0, 0, 0});
    robot.drive(0, 4);
    for (double t : times) robot.fix(t, 2.9, 0.1 * t);
    robot.drive(4, 5);
    EXPECT_EQ(robot.gps().used, 5u);
    const auto last = robot.finish().back().belief;
    if (!first) first = last;
    expectEqual(last, *first);
  } while (std::next_permutation(times.begin(), times.end()));
}

TEST(Localizer, RefusesAFixLaterThanTheWindowAndSaysSo) {
  Robot with, without;
  for (Robot* r : {&with, &without}) {
    r->wheels(0, {0, 0, 0});
    r->drive(0, 6);
  }
  with.fix(3.03, 3, 0.8);  // 2.97 s late, 2 s are allowed
  EXPECT_EQ(with.gps().read, 1u);
  EXPECT_EQ(with.gps().used, 0u);
  EXPECT_EQ(with.gps().refused, (std::map<std::string, uint64_t>{{"too_late", 1}}));
  expectEqual(with.finish().back().belief, without.finish().back().belief);
}

TEST(Localizer, RefusesAFixFromBeforeTheStart) {
  Robot robot;
  robot.wheels(0, {0, 0, 0});
  robot.drive(0, 1);
  robot.fix(-0.5, 0, 0);
  EXPECT_EQ(robot.gps().refused, (std::map<std::string, uint64_t>{{"before_start", 1}}));
}

TEST(Localizer, CountsEachFixOnceHoweverOftenItIsPlayedAgain) {
  Robot robot;
  robot.wheels(0, {0, 0, 0});
  for (int i = 1; i <= 50; ++i) {
    robot.drive(0.1 * (i - 1), 0.1 * i);
    if (i > 5) robot.fix(0.1 * i - 0.43, support::onCircle(1, 0.1, 0.1 * i - 0.43).x, 0);
  }
  robot.finish();
  uint64_t refused = 0;
  for (const auto& [reason, n] : robot.gps().refused) refused += n;
  EXPECT_EQ(robot.gps().read, 45u);
  EXPECT_EQ(robot.gps().used + refused, 45u);
  EXPECT_EQ(robot.gps().nis_count, robot.gps().used);
}

TEST(Localizer, PutsDelayedFixesBackWhereTheyBelong) {
  auto endWith = [](double delay) {
    auto params = fromOrigin();
    params.of<GpsParams>().delay_s = delay;
    Robot robot(params);
    for (int i = 0; i <= 400; ++i) {
      robot.speeds(0.1 * i, 5, 0);
      if (i % 5 == 3) robot.fix(0.1 * i, 5 * (0.1 * i - 0.3), 0);  // what was true 0.3 s ago
    }
    return robot.finish().back().belief.mean.x;
  };
  EXPECT_NEAR(endWith(0.3), 200, 0.01);
  EXPECT_LT(endWith(0), 200 - 0.75);  // 1.5 m behind: at least half of it shows
}

// ---- estimates out ----

TEST(Localizer, GivesOneEstimateAnOdometryReadingInOrder) {
  Robot robot;
  robot.wheels(0, {0, 0, 0});
  for (int i = 1; i <= 50; ++i) {
    robot.drive(0.1 * (i - 1), 0.1 * i);
    robot.fix(0.1 * i - 0.02, support::onCircle(1, 0.1, 0.1 * i).x, 0);
    robot.fix(0.1 * i + 0.02, support::onCircle(1, 0.1, 0.1 * i).x, 0);
  }
  std::vector<Estimate> with_odometry;
  for (const auto& e : robot.finish())
    if (e.odometry_index) with_odometry.push_back(e);
  ASSERT_EQ(with_odometry.size(), 51u);
  for (size_t i = 0; i < 51; ++i) {
    EXPECT_EQ(with_odometry[i].odometry_index, i);
    EXPECT_NEAR(with_odometry[i].time_s, kStart_s + 0.1 * static_cast<double>(i), 1e-6);
    EXPECT_NEAR(with_odometry[i].odometry.x, support::onCircle(1, 0.1, 0.1 * static_cast<double>(i)).x, 1e-6);
  }
}

TEST(Localizer, KeepsTheIndexOfReadingsWhenSomeAreRefusedBeforeTheStart) {
  LocalizerParams params;
  params.of<GpsParams>().sd_m = 0.1;
  Expectation expect;
  expect.positions = true;
  Robot robot(params, expect);
  robot.fix(-0.5, 0, 0);  // before odometry comes
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i) {
    times.push_back(0.1 * i);
    robot.speeds(0.1 * i, 1, 0);
    if (i == 7) {
      times.push_back(0.5);
      robot.speeds(0.5, 1, 0);  // runs backwards: refused
    }
    if (i % 5 == 0) robot.fix(0.1 * i, 0.5 + 0.1 * i, 0);
  }
  std::vector<uint64_t> seen;
  double before = 0;
  for (const auto& e : robot.finish()) {
    EXPECT_GE(e.time_s, before);
    before = e.time_s;
    if (!e.odometry_index) continue;
    seen.push_back(*e.odometry_index);
    EXPECT_NEAR(e.time_s, kStart_s + times[*e.odometry_index], 1e-6) << *e.odometry_index;
  }
  ASSERT_EQ(seen.size(), 101u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.front(), 0u);
  EXPECT_EQ(seen.back(), 101u);
}

// ---- gaps ----

TEST(Localizer, CoastsThroughAGapWithGrowingDoubt) {
  auto params = fromOrigin();
  params.of<GpsParams>().sd_m = 1000;  // fixes that only make time pass
  Robot robot(params);
  for (int i = 0; i <= 50; ++i) robot.speeds(0.1 * i, 1, 0);
  for (int t = 7; t <= 20; ++t) robot.fix(t, 0, 0);
  const auto estimates = robot.finish();
  double before = 0;
  int coasted = 0;
  for (const auto& e : estimates) {
    EXPECT_TRUE(finite(e.belief));
    if (e.time_s < kStart_s + 5.05) continue;
    EXPECT_FALSE(e.odometry_index);
    const double doubt = e.belief.covariance(0, 0) + e.belief.covariance(1, 1);
    EXPECT_GT(doubt, before);
    before = doubt;
    ++coasted;
  }
  EXPECT_GE(coasted, 6);
  EXPECT_GT(before, 1);
}

TEST(Localizer, DoesNotCountMotionTwiceWhenOdometryReturns) {
  auto params = fromOrigin();
  params.of<GpsParams>().sd_m = 1000;
  Robot robot(params);
  for (int i = 0; i <= 50; ++i) robot.wheels(0.1 * i, {0.1 * i, 0, 0});
  robot.fix(6.1, 6.1, 0);  // over a second without odometry: coasts 1 s of motion
  for (int i = 70; i <= 100; ++i) robot.wheels(0.1 * i, {0.1 * i, 0, 0});
  // 5 m + 1 m coasted + (7 - 6.1) / 2 of the step's 2 m + 3 m = 9.9 m; all of the step again would give 11 m.
  EXPECT_NEAR(robot.finish().back().belief.mean.x, 9.9, 0.01);
}

TEST(Localizer, DoubtsMoreAfterAGapInOdometry) {
  auto doubtAfter = [](double gap) {
    Robot robot;
    for (int i = 0; i <= 50; ++i) robot.wheels(0.1 * i, {0.1 * i, 0, 0});
    robot.wheels(5 + gap, {5.5, 0, 0});
    return robot.finish().back().belief.covariance;
  };
  EXPECT_GT(doubtAfter(5)(2, 2), 100 * doubtAfter(0.1)(2, 2));
}

// ---- standing still ----

double yawAfterStanding(Robot& robot) {
  for (int i = 0; i <= 3000; ++i) {
    robot.yawRate(0.02 * i, 0.02);  // 60 s of a gyro that is 0.02 rad/s off: 1.2 rad
    if (i % 5 == 0) robot.speeds(0.02 * i, 0, 0);
  }
  return robot.finish().back().belief.mean.phi;
}

TEST(Localizer, NeitherTurnsNorDoubtsWhileTheRobotStands) {
  Robot robot;
  EXPECT_EQ(yawAfterStanding(robot), 0);
  const auto P = robot.view->estimate().covariance;
  EXPECT_EQ(P(0, 0), 0.05 * 0.05);
  EXPECT_EQ(P(2, 2), 0.02 * 0.02);
}

TEST(Localizer, FollowsTheGyroWhenStandingStillIsNotLookedFor) {
  auto params = fromOrigin();
  params.zero_velocity = false;
  Robot robot(params);
  EXPECT_NEAR(yawAfterStanding(robot), 1.2, 0.001);
}

TEST(Localizer, LearnsTheGyrosBiasWhileTheRobotStands) {
  EkfParams ekf;
  ekf.yaw_rate_bias_sd = 0.03;
  Robot robot(fromOrigin(), {}, ekf);
  EXPECT_EQ(yawAfterStanding(robot), 0);
  std::vector<double> state;
  robot.view->save(state);
  EXPECT_NEAR(state[4], 0.02, 1e-3);  // x, y, yaw, heading offset, bias
}

// ---- the start ----

TEST(Localizer, FindsAnUnknownStartHeadingFromFixes) {
  LocalizerParams params;
  params.of<GpsParams>().sd_m = 0.3;
  Expectation expect;
  expect.positions = true;
  Robot robot(params, expect);
  std::mt19937_64 random(11);
  std::normal_distribution<double> noise(0, 0.3);
  const double c = std::cos(130 * kDegree), s = std::sin(130 * kDegree);
  for (int i = 0; i <= 300; ++i) {
    const double d = 0.1 * i;
    robot.wheels(d, {d, 0, 0});
    if (i % 5 == 0) robot.fix(d, 7 + c * d + noise(random), -3 + s * d + noise(random));
  }
  EXPECT_TRUE(robot.started());
  const auto last = robot.finish().back().belief.mean;
  // 60 fixes of 0.3 m along 30 m: heading to 0.3 * sqrt(12 / 60) / 30 = 0.3 deg, and what the odometry's doubt adds.
  EXPECT_NEAR(last.phi, 130 * kDegree, 3 * kDegree);
  EXPECT_NEAR(last.x, 7 + c * 30, 0.6);
  EXPECT_NEAR(last.y, -3 + s * 30, 0.6);
}

TEST(Localizer, StartsAtOnceFromTheFirstFixWhenTheImuKnowsTheHeading) {
  Expectation expect;
  expect.positions = expect.heading = true;
  Robot robot({}, expect);
  robot.wheels(0, {0, 0, 0});
  EXPECT_FALSE(robot.started());
  robot.yaw(0, 130 * kDegree);
  robot.fix(0, 7, -3);
  EXPECT_TRUE(robot.started());
  robot.wheels(0.1, {0.1, 0, 0});
  const auto last = robot.finish().back().belief.mean;
  EXPECT_NEAR(last.phi, 130 * kDegree, 1e-6);
  EXPECT_NEAR(last.x, 7 + 0.1 * std::cos(130 * kDegree), 0.01);
}

TEST(Localizer, TakesTheImusFrameForTheMapWithoutFixes) {
  Expectation expect;
  expect.heading = true;
  Robot robot({}, expect);
  robot.wheels(0, {0, 0, 0});
  robot.wheels(0.1, {0.1, 0, 0.2});
  robot.yaw(0.1, 1.2);  // the robot has turned by 0.2 since the start: it began at 1.0
  EXPECT_TRUE(robot.started());
  robot.wheels(0.2, {0.1, 0, 0.2});
  const auto estimates = robot.finish();
  EXPECT_NEAR(estimates.front().belief.mean.phi, 1.0, 1e-9);
  EXPECT_NEAR(estimates.back().belief.mean.phi, 1.2, 1e-9);
}

TEST(Localizer, StartsAtTheOriginAtTheEndOfALogWithoutFixes) {
  Expectation expect;
  expect.positions = true;
  Robot robot({}, expect);
  robot.wheels(0, {5, 5, 1});
  robot.wheels(1, {5, 5, 2});
  EXPECT_FALSE(robot.started());
  const auto estimates = robot.finish();
  ASSERT_EQ(estimates.size(), 2u);
  EXPECT_EQ(estimates.front().belief.mean, TPose2D(0, 0, 0));
  EXPECT_NEAR(estimates.back().belief.mean.phi, 1, 1e-9);
}

TEST(Localizer, DoesNotStartFromFixesOrHeadingsThatAreNotFinite) {
  Expectation expect;
  expect.positions = expect.heading = true;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Robot robot({}, expect);
    robot.wheels(0, {0, 0, 0});
    robot.yaw(0, bad);
    robot.fix(0, bad, 0);
    EXPECT_FALSE(robot.started());
    robot.yaw(0.1, 0.5);
    robot.fix(0.1, 7, -3);
    EXPECT_TRUE(robot.started());
    robot.wheels(0.2, {0, 0, 0});
    const auto last = robot.finish().back().belief;
    EXPECT_NEAR(last.mean.x, 7, 1e-9);
    EXPECT_NEAR(last.mean.phi, 0.5, 1e-9);
  }
}

TEST(Localizer, HasNothingToSayOfAnEmptyLog) {
  Robot robot;
  EXPECT_TRUE(robot.finish().empty());
}

// ---- garbage ----

/// A number as damage makes it: ordinary, huge, zero or none at all.
double garbage(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  switch (random() % 12) {
    case 0:
      return std::numeric_limits<double>::quiet_NaN();
    case 1:
      return std::numeric_limits<double>::infinity();
    case 2:
      return 1e308 * unit(random);
    case 3:
      return 0;
    default:
      return 100 * unit(random);
  }
}

void feedGarbage(Robot& robot, double t, std::mt19937_64& random) {
  auto g = [&random]() { return garbage(random); };
  mrpt::obs::CObservationBeaconRanges ranges;
  switch (random() % 7) {
    case 0:
      return robot.wheels(t, {g(), g(), g()});
    case 1:
      return robot.speeds(t, g(), g());
    case 2:
      return robot.fix(t, g(), g());
    case 3:
      return robot.tell(SensorKind::kGps, t, support::fixAt(g(), g(), g()));
    case 4:
      return robot.yaw(t, g());
    case 5:
      return robot.yawRate(t, g());
    default:
      ranges.sensedData.resize(1);
      ranges.sensedData[0].beaconID = 1;
      ranges.sensedData[0].sensedDistance = static_cast<float>(std::clamp(g(), -1e38, 1e38));
      return robot.tell(SensorKind::kBeacons, t, ranges);
  }
}

void expectFiniteWhenFedGarbage(uint64_t seed, bool pose_given, const EkfParams& ekf) {
  LocalizerParams params;
  params.start.pose_given = pose_given;
  params.of<BeaconParams>().beacons = {{1, 3, 4, 2}};
  Expectation expect;
  expect.positions = expect.heading = true;
  Robot robot(params, expect, ekf);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> jitter(-3, 3);
  for (int i = 0; i < 10000; ++i) {
    feedGarbage(robot, 0.02 * i + (i % 50 ? jitter(random) : 0), random);
    for (const auto& e : robot.localizer.takeEstimates()) {
      ASSERT_TRUE(finite(e.belief)) << "seed " << seed << ", observation " << i;
      ASSERT_TRUE(std::isfinite(e.odometry.x) && std::isfinite(e.odometry.y) && std::isfinite(e.odometry.phi)) << i;
    }
  }
  for (const auto& e : robot.finish()) ASSERT_TRUE(finite(e.belief));
  EXPECT_TRUE(robot.started());
}

TEST(Localizer, StaysFiniteWhateverItIsFed) {
  EkfParams full;
  full.heading_offset_sd = full.yaw_rate_bias_sd = full.wheel_scale_sd = 0.1;
  EkfParams open;
  open.gate = false;
  for (uint64_t seed : {21, 22})
    for (const bool pose_given : {true, false})
      for (const EkfParams& ekf : {EkfParams(), full, open}) expectFiniteWhenFedGarbage(seed, pose_given, ekf);
}

}  // namespace
}  // namespace sidestep
