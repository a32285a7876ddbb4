// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/odometry_model.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/errors.h"
#include "support/readings.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;
using mrpt::obs::CObservationOdometry;
using support::kStart_s;
constexpr double kSpeed = 1, kTurnRate = 0.5;  // a circle of 2 m

/// The end of the track that readings at 50 Hz tell of 8 s.
TPose2D endOfTrack(const OdometryParams& params, const std::function<CObservationOdometry(double)>& reading) {
  OdometryModel model(params);
  TPose2D pose{0, 0, 0};
  for (int i = 0; i <= 400; ++i)
    if (auto inc = model.advance(kStart_s + 0.02 * i, reading(0.02 * i))) pose = moved(pose, inc->step);
  return pose;
}

/// Chords instead of arcs: each step turns 0.01 rad, and is short by 0.01^2 / 24 = 4e-6 of itself.
void expectOnCircle(const TPose2D& end, double tolerance) {
  const auto truth = support::onCircle(kSpeed, kTurnRate, 8);
  EXPECT_NEAR(end.x, truth.x, tolerance);
  EXPECT_NEAR(end.y, truth.y, tolerance);
  EXPECT_NEAR(end.phi, truth.phi, 1e-3);
}

TEST(OdometryModel, FollowsPosesOnACircle) {
  expectOnCircle(
      endOfTrack({}, [](double t) { return support::odometryAt(t, support::onCircle(kSpeed, kTurnRate, t)); }), 1e-9);
}

TEST(OdometryModel, FollowsVelocitiesOnACircle) {
  expectOnCircle(endOfTrack({}, [](double t) { return support::velocityAt(t, kSpeed, kTurnRate); }), 1e-4);
}

TEST(OdometryModel, FollowsTicksOnACircle) {
  OdometryParams params;
  params.ticks_left_m = params.ticks_right_m = 1e-5;
  params.track_m = 0.4;
  // (2.2) the other way round: the wheels go v -+ w L / 2 = 0.9 and 1.1 m/s.
  expectOnCircle(endOfTrack(params,
                            [](double t) {
                              auto o = support::odometryAt(t, {0, 0, 0});
                              o.hasEncodersInfo = true;
                              o.encoderLeftTicks = static_cast<int32_t>(std::lround(0.9 * t / 1e-5));
                              o.encoderRightTicks = static_cast<int32_t>(std::lround(1.1 * t / 1e-5));
                              return o;
                            }),
                 1e-4);
}

TEST(OdometryModel, GoesBackwardsWithNegativeDistance) {
  OdometryModel poses({});
  poses.advance(kStart_s, support::odometryAt(0, {0, 0, 1}));
  const auto a = poses.advance(kStart_s + 1, support::odometryAt(1, {-std::cos(1.0), -std::sin(1.0), 1}));
  EXPECT_NEAR(a->step.distance_m, -1, 1e-12);
  OdometryModel speeds({});
  speeds.advance(kStart_s, support::velocityAt(0, -2, 0.1));
  EXPECT_NEAR(speeds.advance(kStart_s + 0.5, support::velocityAt(0.5, -2, 0.1))->step.distance_m, -1, 1e-12);
}

TEST(OdometryModel, ScalesDistancesOnly) {
  OdometryParams params;
  params.scale = 1.1;
  OdometryModel model(params);
  model.advance(kStart_s, support::velocityAt(0, 1, 0.2));
  const auto inc = model.advance(kStart_s + 1, support::velocityAt(1, 1, 0.2));
  EXPECT_NEAR(inc->step.distance_m, 1.1, 1e-12);
  EXPECT_NEAR(inc->step.turn_rad, 0.2, 1e-12);
}

TEST(OdometryModel, StartsAnewAfterAJump) {
  OdometryModel model({});
  EXPECT_FALSE(model.advance(kStart_s, support::odometryAt(0, {500, 0, 0})));
  EXPECT_TRUE(model.advance(kStart_s + 0.1, support::odometryAt(0, {500.1, 0, 0})));
  EXPECT_FALSE(model.advance(kStart_s + 0.2, support::odometryAt(0, {0, 0, 0})));  // 5000 m/s: it was switched on again
  EXPECT_EQ(model.jumps(), 1);
  const auto next = model.advance(kStart_s + 0.3, support::odometryAt(0, {0.1, 0, 0}));
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->step.distance_m, 0.1, 1e-12);
}

TEST(OdometryModel, TellsNothingForAStampThatDoesNotAdvance) {
  OdometryModel model({});
  model.advance(kStart_s, support::odometryAt(0, {0, 0, 0}));
  EXPECT_FALSE(model.advance(kStart_s, support::odometryAt(0, {0.1, 0, 0})));
  EXPECT_FALSE(model.advance(kStart_s - 5, support::odometryAt(0, {0.2, 0, 0})));
  const auto next = model.advance(kStart_s + 0.1, support::odometryAt(0, {0.3, 0, 0}));
  ASSERT_TRUE(next);
  EXPECT_NEAR(next->step.distance_m, 0.3, 1e-12);  // nothing is lost: from the last good reading on
  EXPECT_NEAR(next->step.dt_s, 0.1, 1e-6);
}

TEST(OdometryModel, TellsNothingForReadingsThatAreNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    OdometryModel model({});
    model.advance(kStart_s, support::odometryAt(0, {0, 0, 0}));
    EXPECT_FALSE(model.advance(kStart_s + 1, support::odometryAt(1, {bad, 0, 0})));
    EXPECT_FALSE(model.advance(kStart_s + 2, support::odometryAt(2, {0, 0, bad})));
    model.advance(kStart_s + 3, support::odometryAt(3, {3, 0, 0}));
    const auto next = model.advance(kStart_s + 4, support::odometryAt(4, {4, 0, 0}));
    ASSERT_TRUE(next);
    EXPECT_NEAR(next->step.distance_m, 1, 1e-12);
  }
}

TEST(OdometryModel, WantsWheelSizesForTicks) {
  OdometryParams params;
  params.source = "ticks";
  params.track_m = 0.4;
  try {
    OdometryModel model(params);
    FAIL() << "no error";
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "odometry.source: ticks needs odometry.ticks_left_m, ticks_right_m and track_m above 0");
  }
}

TEST(OdometryModel, SeesThatTheRobotStands) {
  auto stillAt = [](double v, double w) {
    OdometryModel model({});
    model.advance(kStart_s, support::velocityAt(0, v, w));
    return model.advance(kStart_s + 0.1, support::velocityAt(0.1, v, w))->step.still;
  };
  EXPECT_TRUE(stillAt(0, 0));
  EXPECT_TRUE(stillAt(-0.004, 0.004));  // both below the bounds of 0.005
  EXPECT_FALSE(stillAt(0.006, 0));
  EXPECT_FALSE(stillAt(0, -0.006));
}

}  // namespace
}  // namespace sidestep
