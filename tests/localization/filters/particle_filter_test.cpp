// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/particle_filter.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/LU>
#include <cstdlib>
#include <limits>
#include <new>

#include "localization/filters/ekf.h"
#include "localization/localizer.h"
#include "support/measurements.h"
#include "support/readings.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have a malloc of their own
#define SIDESTEP_COUNTS_ALLOCATIONS
namespace {
/// Allocations of this thread since the program began.
thread_local long allocations = 0;
}  // namespace

// glibc's malloc under a counter; Eigen's aligned arrays come through malloc, which on x86-64 aligns to 16.
extern "C" void* __libc_malloc(size_t size);
extern "C" void* malloc(size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace sidestep {
namespace {

using support::beliefOf;
using support::fix;
using support::saved;
using support::stepOf;
using Kind = Measurement::Kind;
using Reason = Correction::Reason;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Measurement heading(double time_s, double yaw, double sd, bool has_offset = false) {
  return support::heading(time_s, yaw, sd, has_offset);
}

Measurement range(double time_s, double r, const Eigen::Vector3d& beacon, double sd) {
  Measurement m;
  m.kind = Kind::kRange;
  m.time_s = time_s;
  m.z(0) = r;
  m.R(0, 0) = sd * sd;
  m.p_map_beacon = beacon;
  return m;
}

Measurement both(double time_s, const mrpt::math::TPose2D& p, double sd) {
  Measurement m = fix(time_s, p.x, p.y, sd);
  m.kind = Kind::kPositionHeading;
  m.z(2) = p.phi;
  m.R(2, 2) = sd * sd;
  return m;
}

bool finite(const PoseBelief& b) {
  return std::isfinite(b.mean.x) && std::isfinite(b.mean.y) && std::isfinite(b.mean.phi) && b.covariance.allFinite();
}

PfParams paramsWith(int particles) {
  PfParams p;
  p.particles = particles;
  p.heading_offset_sd = 0;
  return p;
}

// ---- weights ----

TEST(ParticleFilterCorrect, HasThePosteriorOfTheKalmanFilter) {
  // N(0, 1) and a measurement of 1 with variance 1: N(0.5, 0.5) in x, N(-0.5, 0.5) in y. 40,000 particles of which the
  // weights leave 1 / E[w^2] = 2/3 (in each of x and y): standard errors 0.0055 and 0.0061; 5 of them. The floor of the
  // weights, 0.0013 against a mean of about 0.3, widens the posterior by less than 1 %.
  ParticleFilter filter(paramsWith(40000), 1);
  filter.start(beliefOf({0, 0, 0}, 1, 0.1));
  const auto c = filter.correct(fix(1, 1, -1, 1));
  EXPECT_EQ(c.reason, Reason::kAccepted);
  EXPECT_EQ(c.dof, 2);
  EXPECT_NEAR(c.nis, 1, 0.05);  // 1 / (1 + 1) twice
  const auto b = filter.estimate();
  EXPECT_NEAR(b.mean.x, 0.5, 0.03);
  EXPECT_NEAR(b.mean.y, -0.5, 0.03);
  EXPECT_NEAR(b.covariance(0, 0), 0.5, 0.04);
  EXPECT_NEAR(b.covariance(2, 2), 0.01, 0.0006);
}

TEST(ParticleFilterCorrect, WeighsHeadingsTheShortWayRound) {
  ParticleFilter filter(paramsWith(20000), 2);
  filter.start(beliefOf({0, 0, M_PI - 0.05}, 0.1, 0.1));
  EXPECT_TRUE(filter.correct(heading(1, -M_PI + 0.05, 0.1)).accepted());
  EXPECT_NEAR(std::abs(filter.estimate().mean.phi), M_PI, 0.01);
  EXPECT_NEAR(filter.estimate().covariance(2, 2), 0.005, 0.0005);
}

TEST(ParticleFilterCorrect, FollowsAnExactFilterOfALinearWorldInEachScheme) {
  // Straight ahead along x with a sure heading: a Kalman filter in x alone is exact.
  for (const char* scheme : {"multinomial", "systematic", "stratified", "residual"})
    for (const bool each_step : {false, true}) {
      auto params = paramsWith(4000);
      params.resampling.scheme = scheme;
      params.resampling.each_step = each_step;
      params.gate_probability = 0.999999;
      ParticleFilter filter(params, 3);
      filter.start(beliefOf({0, 0, 0}, 0.5, 0));
      Random random(7);
      double mean = 0, variance = 0.25, truth = 0.2, worst = 0;
      for (int k = 1; k <= 60; ++k) {
        truth += 0.1 + 0.05 * random.gaussian();
        filter.predict(stepOf(0.1, 0.1, 0, 0.05, 0));
        mean += 0.1;
        variance += 0.0025;
        const double z = truth + 0.3 * random.gaussian();
        filter.correct(fix(k, z, 0, 0.3));
        const double gain = variance / (variance + 0.09);
        mean += gain * (z - mean);
        variance *= 1 - gain;
        worst = std::max(worst, std::abs(filter.estimate().mean.x - mean) / std::sqrt(variance));
      }
      EXPECT_LT(worst, 0.25) << scheme << each_step;  // the sampling error of some 1000 effective particles, 60 times
      EXPECT_NEAR(filter.estimate().covariance(0, 0) / variance, 1, 0.25) << scheme << each_step;
    }
}

TEST(ParticleFilterCorrect, ARangeLeavesACircle) {
  auto params = paramsWith(20000);
  ParticleFilter filter(params, 4);
  filter.start(beliefOf({0, 0, 0}, 2, 0.1));
  EXPECT_TRUE(filter.correct(range(1, 5, {0, 0, 3}, 0.05)).accepted());  // 5 in space, 4 on the ground
  const auto& c = filter.cloud();
  double mean = 0;
  for (Eigen::Index i = 0; i < c.x.size(); ++i) mean += c.weight[i] * std::hypot(c.x[i], c.y[i]);
  EXPECT_NEAR(mean, 4, 0.05);
  EXPECT_NEAR(filter.estimate().mean.x, 0, 0.3);  // in all directions alike
  EXPECT_GT(filter.estimate().covariance(0, 0), 6);
}

TEST(ParticleFilterCorrect, TakesTheLeverArmAtEachParticlesHeading) {
  // The antenna is 1 m ahead; the fix is that of a robot at the origin that faces north.
  auto params = paramsWith(20000);
  ParticleFilter filter(params, 5);
  filter.start(beliefOf({0, 0, M_PI / 2 + 0.3}, 0.05, 0.5));
  auto m = fix(1, 0, 1, 0.05);
  m.p_base_sensor << 1, 0, 0;
  EXPECT_TRUE(filter.correct(m).accepted());
  EXPECT_NEAR(filter.estimate().mean.phi, M_PI / 2, 0.03);
}

TEST(ParticleFilterCorrect, ThePrintedLikelihoodIsThatOfAlgorithm3) {
  // Two particles' weights behave as exp(-0.5 EN^0.4); read from the cloud after one correction without resampling.
  auto params = paramsWith(1000);
  params.likelihood = "printed";
  params.resampling.ess_share = 0;
  const auto ratioOf = [&](const Measurement& m, auto norm) {
    ParticleFilter filter(params, 6);
    filter.start(beliefOf({0, 0, 0}, 1, 0.5));
    filter.correct(m);
    const auto& c = filter.cloud();
    for (Eigen::Index i = 1; i < 1000; ++i) {
      const double expected = std::exp(-0.5 * std::pow(norm(c, i), 0.4)) / std::exp(-0.5 * std::pow(norm(c, 0), 0.4));
      ASSERT_NEAR(c.weight[i] / c.weight[0], expected, 1e-6);
    }
  };
  ratioOf(fix(1, 0.3, 0.2, 0.1),
          [](const ParticleCloud& c, Eigen::Index i) { return std::hypot(c.x[i] - 0.3, c.y[i] - 0.2); });
  ratioOf(heading(1, 0.1, 0.1), [](const ParticleCloud& c, Eigen::Index i) { return std::abs(c.yaw[i] - 0.1); });
  ratioOf(both(1, {0.3, 0.2, 0.1}, 0.1), [](const ParticleCloud& c, Eigen::Index i) {
    return std::sqrt(std::pow(c.x[i] - 0.3, 2) + std::pow(c.y[i] - 0.2, 2) + std::pow(c.yaw[i] - 0.1, 2));
  });
}

// ---- motion ----

TEST(ParticleFilterPredict, SpreadsByTheVariancesOfOdometryOrAsPrinted) {
  auto params = paramsWith(40000);
  ParticleFilter by_odometry(params, 7);
  by_odometry.start(PoseBelief());
  by_odometry.predict(stepOf(0.5, 1, 0, 0.1, 0.05));
  EXPECT_NEAR(by_odometry.estimate().covariance(0, 0), 0.01, 0.0005);
  EXPECT_NEAR(by_odometry.estimate().covariance(2, 2), 0.0025, 0.0001);

  params.motion_noise = "printed";  // sd1 dt = 0.02 m, sd2 dt = 0.6, sd3 dt = 0.175 rad
  ParticleFilter printed(params, 7);
  printed.start(PoseBelief());
  printed.predict(stepOf(0.5, 0, 0, 0.1, 0.05));
  EXPECT_NEAR(printed.estimate().covariance(0, 0) + printed.estimate().covariance(1, 1), 0.0004, 0.00002);
  EXPECT_NEAR(printed.estimate().covariance(2, 2), 0.36 + 0.030625, 0.015);
}

TEST(ParticleFilterPredict, LeavesEverythingAsItIsWhileTheRobotStands) {
  ParticleFilter filter(paramsWith(100), 8);
  filter.start(beliefOf({1, 2, 3}, 0.5, 0.1));
  const auto before = saved(filter);
  auto step = stepOf(1, 0.01, 0.01, 1, 1);
  step.still = true;
  filter.predict(step);
  EXPECT_EQ(saved(filter), before);
}

// ---- what is not finite ----

TEST(ParticleFilter, RefusesMotionAndMeasurementsThatAreNotFinite) {
  ParticleFilter filter(paramsWith(100), 9);
  filter.start(beliefOf({1, 2, 3}, 0.5, 0.1));
  const auto before = saved(filter);
  for (const double bad : {kNan, kInfinity, -kInfinity, 1e308}) {
    for (double MotionStep::*field : {&MotionStep::dt_s, &MotionStep::distance_m, &MotionStep::turn_rad,
                                      &MotionStep::distance_var, &MotionStep::turn_var}) {
      auto step = stepOf(1, 1, 0.1, 0.1, 0.1);
      step.*field = bad;
      filter.predict(step);
      EXPECT_EQ(saved(filter), before) << bad;
    }
    for (const auto& good : {fix(1, 0, 0, 1), heading(1, 0, 1), both(1, {0, 0, 0}, 1), range(1, 1, {1, 1, 1}, 1)}) {
      auto z = good, R = good;
      z.z(0) = bad;
      R.R(0, 0) = bad;
      EXPECT_EQ(filter.correct(z).reason, Reason::kNotFinite) << bad;
      EXPECT_EQ(filter.correct(R).reason, Reason::kNotFinite) << bad;
      EXPECT_EQ(saved(filter), before) << bad;
    }
  }
  auto negative = fix(1, 0, 0, 1);
  negative.R(0, 0) = -1;
  EXPECT_EQ(filter.correct(negative).reason, Reason::kNotFinite);
  EXPECT_EQ(saved(filter), before);
}

TEST(ParticleFilter, StaysFiniteWhateverTheMeasurementsSay) {
  for (const char* likelihood : {"gaussian", "printed"}) {
    auto params = paramsWith(50);
    params.likelihood = likelihood;
    params.recovery_patience_s = 3;
    params.resampling.kld = true;
    ParticleFilter filter(params, 10);
    filter.start(beliefOf({0, 0, 0}, 0, 0));
    Random random(11);
    for (int k = 0; k < 3000; ++k) {
      const double size = std::pow(10, random.uniform(-6, 7)), sd = std::pow(10, random.uniform(-9, 4));
      filter.predict(stepOf(0.1, random.uniform(-1, 1), random.uniform(-3, 3), 0.1, 0.1));
      const double x = random.uniform(-size, size), y = random.uniform(-size, size);
      switch (random.below(4)) {
        case 0:
          filter.correct(fix(k, x, y, sd));
          break;
        case 1:
          filter.correct(heading(k, x, sd, true));
          break;
        case 2:
          filter.correct(both(k, {x, y, x}, sd));
          break;
        default:
          filter.correct(range(k, x, {y, x, 0}, sd));
      }
      ASSERT_TRUE(finite(filter.estimate())) << likelihood << k;
      ASSERT_NEAR(filter.cloud().weights().sum(), 1, 1e-9);
    }
  }
}

TEST(ParticleFilter, TakesAnExactMeasurementWithoutDividingByNothing) {
  ParticleFilter filter(paramsWith(500), 12);
  filter.start(beliefOf({0, 0, 0}, 1, 0.1));
  EXPECT_TRUE(filter.correct(fix(1, 0.5, 0.25, 0)).accepted());
  EXPECT_NEAR(filter.estimate().mean.x, 0.5, 1e-3);
  EXPECT_NEAR(filter.estimate().mean.y, 0.25, 1e-3);
}

// ---- outliers, collapse, recovery ----

TEST(ParticleFilterGate, RefusesAFixFarOutsideTheCloudAndSaysWhy) {
  ParticleFilter filter(paramsWith(500), 13);
  filter.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  const auto before = filter.estimate();
  const auto c = filter.correct(fix(1, 20, 0, 0.5));
  EXPECT_EQ(c.reason, Reason::kGated);
  EXPECT_NEAR(c.nis, 800, 150);  // 400 / (0.25 + 0.25)
  EXPECT_EQ(filter.estimate().mean.x, before.mean.x);
}

TEST(ParticleFilterGate, LetsInTheShareItPromises) {
  auto params = paramsWith(2000);
  params.gate_probability = 0.95;
  params.recovery_patience_s = 1e9;
  Random random(14);
  int refused = 0;
  constexpr int kTimes = 1000;
  for (int k = 0; k < kTimes; ++k) {
    ParticleFilter filter(params, static_cast<uint64_t>(k));
    filter.start(beliefOf({0, 0, 0}, 0.2, 0.1));
    const double sd = std::sqrt(0.04 + 1);
    refused += !filter.correct(fix(1, sd * random.gaussian(), sd * random.gaussian(), 1)).accepted();
  }
  // 5 % are outside the gate; a few of those some particle explains.
  EXPECT_LE(refused, 50 + 5 * 7);
  EXPECT_GE(refused, 25 - 5 * 5);
}

TEST(ParticleFilterRecovery, AFixMuchSharperThanTheCloudMovesItThere) {
  // After an outage: the cloud is 50 m wide, the fix 5 cm sharp. No particle is within 5 cm.
  ParticleFilter filter(paramsWith(500), 15);
  filter.start(beliefOf({0, 0, 0}, 50, 0.5));
  EXPECT_TRUE(filter.correct(fix(1, 40, -30, 0.05)).accepted());
  const auto b = filter.estimate();
  EXPECT_NEAR(b.mean.x, 40, 0.1);
  EXPECT_NEAR(b.mean.y, -30, 0.1);
  EXPECT_NEAR(std::sqrt(b.covariance(0, 0)), 0.05, 0.01);
  EXPECT_NEAR(b.covariance(2, 2), 0.25, 0.05);  // the heading is as unknown as it was
}

TEST(ParticleFilterRecovery, ARobotThatWasCarriedAwayIsFoundAgain) {
  auto params = paramsWith(500);
  params.recovery_patience_s = 5;
  ParticleFilter filter(params, 16);
  filter.start(beliefOf({0, 0, 0}, 0.3, 0.05));
  Random random(17);
  mrpt::math::TPose2D truth{100, 50, 2};
  int resets = 0;
  for (int k = 1; k <= 60; ++k) {
    const auto step = stepOf(1, 1, 0.05, 0.05, 0.02);
    truth = moved(truth, step);
    filter.predict(step);
    resets +=
        filter.correct(fix(k, truth.x + random.gaussian(), truth.y + random.gaussian(), 1)).reason == Reason::kReset;
  }
  EXPECT_GE(resets, 1);
  const auto b = filter.estimate();
  EXPECT_NEAR(b.mean.x, truth.x, 1.5);
  EXPECT_NEAR(b.mean.y, truth.y, 1.5);
  EXPECT_NEAR(std::remainder(b.mean.phi - truth.phi, 2 * M_PI), 0, 0.3);
}

TEST(ParticleFilterRecovery, HeadingsAndRangesRecoverToo) {
  auto params = paramsWith(500);
  params.recovery_patience_s = 2;
  ParticleFilter by_heading(params, 18), by_range(params, 18);
  by_heading.start(beliefOf({0, 0, 0}, 0.1, 0.05));
  by_range.start(beliefOf({0, 0, 0}, 0.1, 0.05));
  for (int k = 1; k <= 20; ++k) {
    by_heading.correct(heading(k, 2.5, 0.05));
    by_range.correct(range(k, 10, {0, 0, 0}, 0.1));
  }
  EXPECT_NEAR(by_heading.estimate().mean.phi, 2.5, 0.05);
  double mean = 0;
  const auto& c = by_range.cloud();
  for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(c.size()); ++i)
    mean += c.weight[i] * std::hypot(c.x[i], c.y[i]);
  EXPECT_NEAR(mean, 10, 0.5);
}

TEST(ParticleFilterModes, TwoBeaconsLeaveTwoPlacesUntilTheThird) {
  // Beacons on a line: the robot is left or right of it.
  auto params = paramsWith(5000);
  params.resampling.kld_cell_m = 0.5;
  ParticleFilter filter(params, 19);
  filter.start(beliefOf({5, 0, 0}, 4, 0.1));
  const double r = std::hypot(5, 4);
  for (int k = 1; k <= 5; ++k) {
    filter.correct(range(k, r, {0, 0, 0}, 0.3));
    filter.correct(range(k, r, {10, 0, 0}, 0.3));
  }
  const auto two = filter.modes();
  ASSERT_EQ(two.size(), 2u);
  EXPECT_GT(two[1].weight, 0.3);
  EXPECT_NEAR(std::abs(two[0].belief.mean.y), 4, 0.2);
  EXPECT_NEAR(two[0].belief.mean.y, -two[1].belief.mean.y, 0.3);
  EXPECT_GT(filter.estimate().covariance(1, 1), 10);  // one mean between the two, and it says how sure it is
  for (int k = 6; k <= 10; ++k) filter.correct(range(k, 2, {5, 2, 0}, 0.3));
  const auto one = filter.modes();
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].belief.mean.y, 4, 0.3);
}

// ---- size ----

TEST(ParticleFilterKld, TakesMoreParticlesForAWiderCloud) {
  auto params = paramsWith(500);
  params.resampling.kld = true;
  params.resampling.each_step = true;
  params.resampling.kld_error = 0.05;
  const auto sizeAt = [&](double sd) {
    ParticleFilter filter(params, 20);
    filter.start(beliefOf({0.12, 0.12, 0.09}, sd, 0.02));
    for (int k = 0; k < 5; ++k) filter.correct(fix(k, 0.12, 0.12, 100));
    return filter.cloud().size();
  };
  EXPECT_EQ(sizeAt(0.01), 100u);  // the fewest: one place
  EXPECT_GT(sizeAt(1), 1500u);
  EXPECT_LE(sizeAt(30), 20000u);
  EXPECT_GT(sizeAt(30), sizeAt(1));
}

TEST(ParticleFilterRoughening, KeepsParticlesApartOnARobotThatStands) {
  const auto distinct = [](double roughening) {
    auto params = paramsWith(500);
    params.resampling.roughening = roughening;
    ParticleFilter filter(params, 21);
    filter.start(beliefOf({0, 0, 0}, 2, 0.2));
    for (int k = 1; k <= 200; ++k) filter.correct(fix(k, 0, 0, 1));
    std::vector<double> x(filter.cloud().x.data(), filter.cloud().x.data() + 500);
    std::sort(x.begin(), x.end());
    return std::unique(x.begin(), x.end()) - x.begin();
  };
  EXPECT_LT(distinct(0), 60);
  EXPECT_GT(distinct(0.1), 400);
}

// ---- calibration ----

TEST(ParticleFilterCalibration, FindsTheOffsetOfTheHeadingFromFixes) {
  auto params = paramsWith(1000);
  params.heading_offset_sd = 0.8;
  ParticleFilter filter(params, 22);
  filter.start(beliefOf({0, 0, 0}, 1, 0.5));
  Random random(23);
  mrpt::math::TPose2D truth{0, 0, 0.2};
  for (int k = 1; k <= 200; ++k) {
    const auto step = stepOf(0.5, 0.5, 0.02, 0.02, 0.01);
    truth = moved(truth, step);
    filter.predict(step);
    filter.correct(heading(0.5 * k, truth.phi + 0.6 + 0.05 * random.gaussian(), 0.05, true));
    filter.correct(fix(0.5 * k, truth.x + 0.5 * random.gaussian(), truth.y + 0.5 * random.gaussian(), 0.5));
  }
  EXPECT_NEAR(std::remainder(filter.estimate().mean.phi - truth.phi, 2 * M_PI), 0, 0.05);
  const auto& c = filter.cloud();
  EXPECT_NEAR((c.weights() * c.offset.head(static_cast<Eigen::Index>(c.size()))).sum(), 0.6, 0.05);
}

TEST(ParticleFilterCalibration, LearnsTheBiasOfAGyroAtRest) {
  auto params = paramsWith(200);
  Measurement still;
  still.kind = Kind::kStill;
  still.z(0) = 0.05;
  still.R(0, 0) = 1e-6;
  ParticleFilter without(params, 24);
  EXPECT_EQ(without.correct(still).reason, Reason::kNotObservable);
  params.yaw_rate_bias_sd = 0.1;
  ParticleFilter with(params, 24);
  with.start(beliefOf({0, 0, 1}, 0, 0));
  EXPECT_TRUE(with.correct(still).accepted());
  auto step = stepOf(10, 1, 0.5);
  step.turn_from_gyro = true;
  with.predict(step);
  EXPECT_NEAR(with.estimate().mean.phi, 1, 0.005);  // 0.5 rad in 10 s were all bias
}

TEST(ParticleFilterCalibration, LearnsGyroBiasAndWheelScaleWhileMoving) {
  // The gyro reads 0.03 rad/s too much, the wheels 5 % too little; only fixes tell.
  auto params = paramsWith(1000);
  params.yaw_rate_bias_sd = 0.05;
  params.wheel_scale_sd = 0.1;
  ParticleFilter filter(params, 26);
  filter.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  Random random(27);
  mrpt::math::TPose2D truth{0, 0, 0};
  for (int k = 1; k <= 600; ++k) {
    const double turn = 0.1 * std::sin(0.05 * k);
    auto step = stepOf(0.5, 0.5 / 1.05, turn + 0.03 * 0.5, 0.01, 0.005);
    step.turn_from_gyro = true;
    truth = moved(truth, stepOf(0.5, 0.5, turn));
    filter.predict(step);
    filter.correct(fix(0.5 * k, truth.x + 0.3 * random.gaussian(), truth.y + 0.3 * random.gaussian(), 0.3));
  }
  const auto& c = filter.cloud();
  const auto n = static_cast<Eigen::Index>(c.size());
  EXPECT_NEAR((c.weights() * c.bias.head(n)).sum(), 0.03, 0.005);
  EXPECT_NEAR((c.weights() * c.scale.head(n)).sum(), 0.05, 0.02);
  EXPECT_NEAR(std::remainder(filter.estimate().mean.phi - truth.phi, 2 * M_PI), 0, 0.05);
}

TEST(ParticleFilterCalibration, WhatIsLearntIsPartOfTheState) {
  auto params = paramsWith(100);
  params.yaw_rate_bias_sd = 0.05;
  params.wheel_scale_sd = 0.1;
  ParticleFilter a(params, 28), b(params, 29);
  a.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  auto step = stepOf(1, 1, 0.1, 0.1, 0.1);
  step.turn_from_gyro = true;
  a.predict(step);
  a.correct(fix(1, 1.2, 0.3, 0.2));
  b.restore(saved(a));
  for (auto* f : {&a, &b}) {
    f->predict(step);
    f->correct(fix(2, 2.3, 0.5, 0.2));
  }
  EXPECT_TRUE(saved(a) == saved(b));
}

// ---- consistency ----

TEST(ParticleFilterConsistency, HasTheErrorsThatItsCovarianceSays) {
  // NEES has mean 3 and variance 6: 200 independent runs have a standard error of 0.173. The cloud's covariance is
  // itself a sample of some 300 effective particles, and short of the truth by a few percent.
  double sum = 0;
  constexpr int kRuns = 200;
  for (uint64_t run = 0; run < kRuns; ++run) {
    Random random(25, run);
    auto params = paramsWith(1000);
    params.gate_probability = 0.999999;
    ParticleFilter filter(params, run);
    mrpt::math::TPose2D truth{random.gaussian(), random.gaussian(), 0.2 * random.gaussian()};
    filter.start(beliefOf({0, 0, 0}, 1, 0.2));
    for (int k = 1; k <= 30; ++k) {
      truth = moved(truth, stepOf(0.5, 0.5 + 0.05 * random.gaussian(), 0.1 + 0.05 * random.gaussian()));
      filter.predict(stepOf(0.5, 0.5, 0.1, 0.05, 0.05));
      filter.correct(fix(k, truth.x + 0.5 * random.gaussian(), truth.y + 0.5 * random.gaussian(), 0.5));
      if (k % 3 == 0) filter.correct(heading(k, truth.phi + 0.1 * random.gaussian(), 0.1));
    }
    const auto b = filter.estimate();
    const Eigen::Vector3d e(b.mean.x - truth.x, b.mean.y - truth.y, mrpt::math::wrapToPi(b.mean.phi - truth.phi));
    sum += e.dot(b.covariance.inverse() * e) / kRuns;
  }
  EXPECT_NEAR(sum, 3, 3.5 * 0.173);
}

// ---- determinism, replay, memory ----

void drive(ParticleFilter& filter, int from, int to) {
  for (int k = from; k < to; ++k) {
    filter.predict(stepOf(0.1, 0.1, 0.02, 0.01, 0.01));
    const double t = 0.1 * k;
    filter.correct(k % 2 ? fix(k, std::sin(t), t, 0.3) : heading(k, 0.01 * k, 0.2, true));
  }
}

TEST(ParticleFilterState, ContinuesBitForBitAfterSaveAndRestore) {
  for (const bool kld : {false, true}) {
    PfParams params;
    params.resampling.kld = kld;
    ParticleFilter filter(params, 26), other(params, 99);
    filter.start(beliefOf({0, 0, 0}, 1, 0.3));
    drive(filter, 0, 50);
    const auto middle = saved(filter);
    drive(filter, 50, 100);
    other.restore(middle);
    EXPECT_EQ(saved(other), middle);
    drive(other, 50, 100);
    EXPECT_EQ(saved(other), saved(filter));
  }
}

TEST(ParticleFilterState, DependsOnTheSeed) {
  ParticleFilter a(PfParams(), 1), b(PfParams(), 1), c(PfParams(), 2);
  for (auto* f : {&a, &b, &c}) {
    f->start(beliefOf({0, 0, 0}, 1, 0.3));
    drive(*f, 0, 20);
  }
  EXPECT_EQ(saved(a), saved(b));
  EXPECT_NE(a.estimate().mean.x, c.estimate().mean.x);
}

TEST(ParticleFilterState, ALateFixGivesTheSameAsOneInTime) {
  const auto run = [](int late_steps) {
    LocalizerParams params;
    params.start.pose_given = true;
    params.start.position_sd_m = 0.5;
    Localizer localizer(params, makeParticleFilter(PfParams(), 5), {});
    for (int i = 0; i <= 100; ++i) {
      const double t = support::kStart_s + 0.1 * i;
      localizer.observe(support::wheelsAt(t, support::onCircle(1, 0.1, 0.1 * i)));
      const auto p = support::onCircle(1, 0.1, 4.55);
      if (i == 45 + late_steps) localizer.observe(support::positionAt(support::kStart_s + 4.55, p.x + 1, p.y));
    }
    localizer.finish();
    return localizer.takeEstimates().back().belief.mean;
  };
  const auto in_time = run(0), late = run(10);
  // The same numbers are drawn; the step is split by times that are rounded to 0.2 us.
  EXPECT_NEAR(in_time.x, late.x, 1e-6);
  EXPECT_NEAR(in_time.y, late.y, 1e-6);
  EXPECT_NEAR(in_time.phi, late.phi, 1e-6);
  EXPECT_GT(std::abs(in_time.x - run(1000).x), 1e-3);  // the fix does matter
}

#ifdef SIDESTEP_COUNTS_ALLOCATIONS
TEST(ParticleFilterMemory, AStepDoesNotAllocate) {
  PfParams params;
  params.resampling.kld = true;
  params.resampling.kld_max = 2000;
  for (const char* scheme : {"multinomial", "systematic", "stratified", "residual"}) {
    params.resampling.scheme = scheme;
    ParticleFilter filter(params, 27);
    filter.start(beliefOf({0, 0, 0}, 1, 0.3));
    const long before = allocations;
    drive(filter, 0, 100);
    filter.correct(fix(11, 0, 11, 0.001));
    for (int k = 0; k < 20; ++k) filter.correct(fix(20 + k, 500, 500, 0.1));
    EXPECT_TRUE(finite(filter.estimate()));
    EXPECT_EQ(allocations, before) << scheme;
  }
}
#endif

}  // namespace
}  // namespace sidestep
