// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/ekf.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <random>

#include "support/jacobian.h"
#include "support/measurements.h"

namespace sidestep {
namespace {

using support::beliefOf;
using support::fix;
using support::saved;
using support::stepOf;

Measurement heading(double time_s, double yaw, double sd) { return support::heading(time_s, yaw, sd, true); }

using Kind = Measurement::Kind;
using Reason = Correction::Reason;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool finite(const PoseBelief& b) {
  return std::isfinite(b.mean.x) && std::isfinite(b.mean.y) && std::isfinite(b.mean.phi) && b.covariance.allFinite();
}

// ---- the chi-square gate's bounds ----

TEST(ChiSquareQuantile, AgreesWithTheTextbook) {
  EXPECT_NEAR(chiSquareQuantile(0.95, 1), 3.841459, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.95, 2), 5.991465, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.95, 3), 7.814728, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 1), 6.634897, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 2), 9.210340, 1e-6);
  EXPECT_NEAR(chiSquareQuantile(0.99, 3), 11.344867, 1e-6);
}

// ---- prediction ----

/// The state as the tests lay it out: N numbers of mean, then the covariance, then the gate's memory.
template <int N>
struct Whole {
  Eigen::Matrix<double, N, 1> x;
  Eigen::Matrix<double, N, N> P;
  explicit Whole(const Ekf<N>& ekf) {
    const auto s = saved(ekf);
    std::copy(s.begin(), s.begin() + N, x.data());
    std::copy(s.begin() + N, s.begin() + N + N * N, P.data());
  }
  void into(Ekf<N>& ekf) const {
    auto s = saved(ekf);
    std::copy(x.data(), x.data() + N, s.begin());
    std::copy(P.data(), P.data() + N * N, s.begin() + N);
    ekf.restore(s);
  }
};

template <int N>
Eigen::VectorXd predicted(const Eigen::VectorXd& x, const MotionStep& step) {
  Ekf<N> ekf({});
  Whole<N> s(ekf);
  s.x = x;
  s.into(ekf);
  ekf.predict(step);
  return Whole<N>(ekf).x;
}

/// P' = F P F' + W Q W' with F and W by central differences of the predicted mean.
template <int N>
void expectCovarianceOfCentralDifferences() {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 100; ++i) {
    Ekf<N> ekf({});
    Whole<N> s(ekf);
    for (int k = 0; k < N; ++k) s.x(k) = k < 3 ? unit(random) : 0.2 * unit(random);
    if (N > 5) s.x.tail(3).setZero();  // the noise is that of the true distance and turn
    const Eigen::Matrix<double, N, N> A = Eigen::Matrix<double, N, N>::NullaryExpr([&]() { return unit(random); });
    s.P = A * A.transpose();
    s.into(ekf);
    auto step = stepOf(0.7, 2 * unit(random), unit(random), 0.3, 0.2);
    step.turn_from_gyro = i % 2;
    ekf.predict(step);
    const Eigen::MatrixXd F =
        support::centralDifferences([&](const Eigen::VectorXd& x) { return predicted<N>(x, step); }, s.x);
    const auto byInput = [&](const Eigen::VectorXd& u) {
      auto other = step;
      other.distance_m = u(0);
      other.turn_rad = u(1);
      return predicted<N>(s.x, other);
    };
    const Eigen::MatrixXd W = support::centralDifferences(byInput, Eigen::Vector2d(step.distance_m, step.turn_rad));
    const Eigen::Vector2d q(step.distance_var, step.turn_var);
    const Eigen::MatrixXd expected = F * s.P * F.transpose() + W * q.asDiagonal() * W.transpose();
    EXPECT_LT((Whole<N>(ekf).P - expected).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(EkfPredict, HasTheJacobiansOfCentralDifferences) { expectCovarianceOfCentralDifferences<3>(); }
TEST(EkfPredict, HasTheJacobiansOfCentralDifferencesWithCalibration) { expectCovarianceOfCentralDifferences<8>(); }

TEST(EkfPredict, GivesTheSpreadOfSampledMotions) {
  // 1e5 motions drawn from the noise; small enough that the model is all but linear.
  const auto step = stepOf(1, 1, 0.5, 0.02, 0.01);
  Ekf<3> ekf({});
  ekf.start(beliefOf({0, 0, 0.3}, 0, 0));
  ekf.predict(step);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 100000;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const auto mean = ekf.estimate().mean;
  for (int i = 0; i < kSamples; ++i) {
    const auto p = moved({0, 0, 0.3}, stepOf(1, 1 + 0.02 * normal(random), 0.5 + 0.01 * normal(random)));
    const Eigen::Vector3d d(p.x - mean.x, p.y - mean.y, p.phi - mean.phi);
    spread += d * d.transpose() / kSamples;
  }
  // A sample covariance has a standard error of about sqrt(2/n) = 0.45 % of the sizes involved; 5 of them.
  EXPECT_LT((spread - ekf.estimate().covariance).norm(), 5 * 0.0045 * ekf.estimate().covariance.norm());
}

TEST(EkfPredict, LeavesEverythingAsItIsWhileTheRobotStands) {
  Ekf<3> ekf({});
  ekf.start(beliefOf({1, 2, 3}, 0.5, 0.1));
  const auto before = saved(ekf);
  auto step = stepOf(1, 0.01, 0.01, 1, 1);
  step.still = true;
  ekf.predict(step);
  EXPECT_EQ(saved(ekf), before);
}

TEST(EkfPredict, IgnoresMotionThatIsNotFinite) {
  for (int size : {3, 6}) {
    EkfParams params;
    params.yaw_rate_bias_sd = size == 6 ? 0.1 : 0;
    const auto ekf = makeEkf(params);
    ekf->start(beliefOf({1, 2, 3}, 0.5, 0.1));
    const auto before = saved(*ekf);
    for (const double bad : {kNan, kInfinity, -kInfinity, 1e308}) {
      for (double MotionStep::*field : {&MotionStep::dt_s, &MotionStep::distance_m, &MotionStep::turn_rad,
                                        &MotionStep::distance_var, &MotionStep::turn_var}) {
        auto step = stepOf(1, 1, 0.1, 0.1, 0.1);
        step.turn_from_gyro = true;
        step.*field = bad;
        ekf->predict(step);
        ekf->predict(step);
        EXPECT_TRUE(finite(ekf->estimate())) << bad;
        for (double v : saved(*ekf)) EXPECT_TRUE(std::isfinite(v));
        ekf->restore(before);
      }
    }
    ekf->predict(stepOf(-1, 1, 0, 0.1, 0.1));  // time that runs backwards
    EXPECT_EQ(saved(*ekf), before);
  }
}

// ---- correction ----

TEST(EkfCorrect, HasTheGainOfTheKalmanFilterInOneDimension) {
  // P = 4, R = 1: K = P / (P + R) = 0.8, x = 0.8 * 1, P' = (1 - K) P = 0.8, nis = 1 / (P + R) + 0.
  Ekf<3> ekf({});
  ekf.start(beliefOf({0, 0, 0}, 2, 0));
  const auto c = ekf.correct(fix(1, 1, 0, 1));
  EXPECT_EQ(c.reason, Reason::kAccepted);
  EXPECT_EQ(c.dof, 2);
  EXPECT_NEAR(c.nis, 0.2, 1e-14);
  const auto b = ekf.estimate();
  EXPECT_NEAR(b.mean.x, 0.8, 1e-14);
  EXPECT_NEAR(b.mean.y, 0, 1e-14);
  EXPECT_NEAR(b.covariance(0, 0), 0.8, 1e-14);
  EXPECT_NEAR(b.covariance(1, 1), 0.8, 1e-14);
}

TEST(EkfCorrect, TurnsTheShortWayAndKeepsTheHeadingInRange) {
  Ekf<3> ekf({});
  ekf.start(beliefOf({0, 0, M_PI - 0.05}, 1, 0.1));
  ekf.correct(heading(1, -M_PI + 0.05, 0.1));  // equal trust: half way, 180 deg
  EXPECT_NEAR(std::abs(ekf.estimate().mean.phi), M_PI, 1e-12);
  EXPECT_NEAR(ekf.estimate().covariance(2, 2), 0.005, 1e-14);
}

TEST(EkfCorrect, TakesPositionAndHeadingTogetherAsOneAfterTheOther) {
  Measurement both = fix(1, 1, 2, 0.5);
  both.kind = Kind::kPositionHeading;
  both.z(2) = 0.1;
  both.R(2, 2) = 0.01;
  Ekf<3> a({}), b({});
  a.start(beliefOf({0, 0, 0}, 1, 0.2));
  b.start(beliefOf({0, 0, 0}, 1, 0.2));
  a.correct(both);
  b.correct(fix(1, 1, 2, 0.5));  // no lever arm: the model is linear, and the order does not matter
  b.correct(heading(1, 0.1, 0.1));
  EXPECT_NEAR(a.estimate().mean.x, b.estimate().mean.x, 1e-12);
  EXPECT_NEAR(a.estimate().mean.phi, b.estimate().mean.phi, 1e-12);
  EXPECT_LT((a.estimate().covariance - b.estimate().covariance).norm(), 1e-12);
}

template <int N>
void expectSymmetricPositive() {
  EkfParams params;
  params.gate = false;
  params.heading_offset_sd = params.yaw_rate_bias_sd = params.wheel_scale_sd = N > 3 ? 0.1 : 0;
  Ekf<N> ekf(params);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> unit(-1, 1);
  std::uniform_int_distribution<int> kind(0, 4);
  ekf.start(beliefOf({0, 0, 0}, 1e6, 10));  // P of 1e12
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    if (i % 1000 == 999) ekf.start(beliefOf({unit(random), 0, 0}, std::pow(10, 6 * unit(random)), 10));
    auto step = stepOf(0.1, unit(random), unit(random), i % 3 ? 0.01 : 0, i % 5 ? 0.01 : 0);
    step.turn_from_gyro = i % 2;
    ekf.predict(step);
    Measurement m = fix(0.1 * i, 10 * unit(random), 10 * unit(random), 1);
    m.kind = static_cast<Kind>(kind(random));
    m.heading_has_offset = i % 4;
    m.p_base_sensor << unit(random), unit(random), 1;
    m.p_map_beacon << 10, 3, 2;
    m.R = Eigen::Matrix3d::Identity() * std::pow(10, -6 + 6 * unit(random));  // 1e-12 .. 1
    ekf.correct(m);
    const Eigen::Matrix<double, N, N> P = Whole<N>(ekf).P;
    ASSERT_TRUE(P.allFinite()) << i;
    ASSERT_LE((P - P.transpose()).cwiseAbs().maxCoeff(), 1e-15 * P.cwiseAbs().maxCoeff()) << i;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> eigen(P, Eigen::EigenvaluesOnly);
    worst = std::min(worst, eigen.eigenvalues().minCoeff() / eigen.eigenvalues().maxCoeff());
    ASSERT_GE(P.diagonal().minCoeff(), 0) << i;
  }
  // Variances span 24 decades here, doubles 16: the smallest eigenvalue is known to some hundred roundings of the
  // largest.
  EXPECT_GE(worst, -1e-12);
}

TEST(EkfCorrect, KeepsTheCovarianceSymmetricAndPositive) { expectSymmetricPositive<3>(); }
TEST(EkfCorrect, KeepsTheCovarianceSymmetricAndPositiveWithCalibration) { expectSymmetricPositive<8>(); }

TEST(EkfCorrect, RefusesMeasurementsThatAreNotFinite) {
  for (int size : {3, 6}) {
    EkfParams params;
    params.heading_offset_sd = size == 6 ? 0.1 : 0;
    for (const bool gate : {true, false}) {
      params.gate = gate;
      const auto ekf = makeEkf(params);
      ekf->start(beliefOf({1, 2, 3}, 0.5, 0.1));
      const auto before = saved(*ekf);
      for (const Kind kind : {Kind::kPosition, Kind::kHeading, Kind::kPositionHeading, Kind::kRange}) {
        for (const double bad : {kNan, kInfinity, -kInfinity}) {
          Measurement m = fix(1, 1, 2, 1);
          m.kind = kind;
          m.R(2, 2) = 1;
          m.z(0) = bad;
          EXPECT_EQ(ekf->correct(m).reason, Reason::kNotFinite) << bad;
          m.z(0) = 1;
          m.R(0, 0) = bad;
          EXPECT_EQ(ekf->correct(m).reason, Reason::kNotFinite) << bad;
          EXPECT_EQ(saved(*ekf), before);
        }
      }
      Measurement negative = fix(1, 1, 2, 1);
      negative.R(0, 0) = -0.1;  // with P = 0.25 the innovation's covariance would still be positive
      EXPECT_EQ(ekf->correct(negative).reason, Reason::kNotFinite);
      EXPECT_EQ(saved(*ekf), before);
    }
  }
  EXPECT_STREQ(word(Reason::kNotFinite), "not_finite");
}

TEST(EkfCorrect, StaysFiniteWhenNothingIsUncertain) {
  Ekf<3> ekf({});
  ekf.start(beliefOf({1, 2, 3}, 0, 0));
  EXPECT_FALSE(ekf.correct(fix(1, 1, 2, 0)).accepted());  // P + R = 0 has no inverse
  EXPECT_TRUE(finite(ekf.estimate()));
}

TEST(EkfCorrect, SaysThatAGyroAtRestTellsNothingWithoutABiasInTheState) {
  Ekf<3> ekf({});
  ekf.start(beliefOf({0, 0, 0}, 1, 1));
  Measurement still;
  still.kind = Kind::kStill;
  still.R(0, 0) = 1;
  EXPECT_EQ(ekf.correct(still).reason, Reason::kNotObservable);
  EXPECT_STREQ(word(Reason::kNotObservable), "not_usable");
}

// ---- the gate ----

TEST(EkfGate, RefusesAFixTenSigmaAwayAndSaysWhy) {
  Ekf<3> ekf({});
  ekf.start(beliefOf({0, 0, 0}, 1, 0.1));
  const auto before = ekf.estimate();
  const auto c = ekf.correct(fix(1, 10 * std::sqrt(2.0), 0, 1));  // sqrt(P + R) = sqrt 2
  EXPECT_EQ(c.reason, Reason::kGated);
  EXPECT_STREQ(word(c.reason), "outside_gate");
  EXPECT_NEAR(c.nis, 100, 1e-10);
  EXPECT_EQ(ekf.estimate().mean.x, before.mean.x);
  EXPECT_EQ(ekf.estimate().covariance, before.covariance);
}

TEST(EkfGate, LetsTheSameFixInWhenItIsOff) {
  EkfParams params;
  params.gate = false;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 1, 0.1));
  EXPECT_EQ(ekf.correct(fix(1, 10 * std::sqrt(2.0), 0, 1)).reason, Reason::kAccepted);
  EXPECT_NEAR(ekf.estimate().mean.x, 5 * std::sqrt(2.0), 1e-12);
}

TEST(EkfGate, LetsInTheShareItPromises) {
  EkfParams params;
  params.gate_probability = 0.9;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 1, 0.1));
  const auto before = saved(ekf);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, std::sqrt(2.0));
  int in = 0;
  for (int i = 0; i < 10000; ++i) {
    ekf.restore(before);
    in += ekf.correct(fix(1, normal(random), normal(random), 1)).accepted();
  }
  EXPECT_NEAR(in, 9000, 4 * 30);  // binomial: sd = sqrt(10000 * 0.9 * 0.1) = 30
}

TEST(EkfGate, BelievesPositionsAgainThatWereAllRefusedForLongerThanItsPatience) {
  EkfParams params;
  params.gate_patience_s = 10;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.1, 0.01));
  for (int t = 1; t < 11; ++t) EXPECT_EQ(ekf.correct(fix(t, 50, 0, 1)).reason, Reason::kGated) << t;
  const auto c = ekf.correct(fix(11, 50, 0, 1));
  EXPECT_EQ(c.reason, Reason::kReset);
  EXPECT_STREQ(word(c.reason), "accepted_after_reset");
  EXPECT_GT(ekf.estimate().mean.x, 40);
  EXPECT_EQ(ekf.correct(fix(12, 50, 0, 1)).reason, Reason::kAccepted);
}

TEST(EkfGate, NeverBelievesOneBadSensorAmongGoodOnes) {
  EkfParams params;
  params.gate_patience_s = 10;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.1, 0.01));
  for (int t = 1; t < 200; ++t) {
    ekf.predict(stepOf(1, 0, 0, 0.1, 0.01));
    EXPECT_EQ(ekf.correct(fix(t, 50, 0, 1)).reason, Reason::kGated) << t;
    EXPECT_TRUE(ekf.correct(fix(t + 0.5, 0, 0, 1)).accepted()) << t;
  }
  EXPECT_LT(std::abs(ekf.estimate().mean.x), 0.1);
}

TEST(EkfGate, KeepsPatienceWithPositionsApartFromHeadings) {
  EkfParams params;
  params.gate_patience_s = 10;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.1, 0.01));
  Correction last;
  for (int t = 1; t <= 11; ++t) {
    EXPECT_TRUE(ekf.correct(heading(t, 0, 0.1)).accepted());
    last = ekf.correct(fix(t, 50, 0, 1));
  }
  EXPECT_EQ(last.reason, Reason::kReset);  // good headings say nothing about positions
}

TEST(EkfGate, StaysFiniteWhenAResetWouldOverflow) {
  EkfParams params;
  params.gate_patience_s = 0;
  Ekf<3> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 1e150, 1));
  const auto before = saved(ekf);
  EXPECT_FALSE(ekf.correct(fix(1, 1e160, 1e160, 1e-150)).accepted() && !finite(ekf.estimate()));
  ekf.restore(before);
  Ekf<3> narrow(params);
  narrow.start(beliefOf({0, 0, 0}, 1e5, 1));
  narrow.correct(fix(1, 1e153, 1e153, 1));
  narrow.correct(fix(1, -1e158, 1e158, 1));
  EXPECT_TRUE(finite(narrow.estimate()));
}

// ---- calibration ----

/// A robot that drives a figure of eight with a wrong gyro, wheel scale and IMU heading.
struct Drive {
  std::mt19937_64 random;
  std::normal_distribution<double> normal{0, 1};
  double bias = 0, scale = 0, offset = 0, turn_scale = 0, pull = 0;
  bool gyro = true;
  double distance_sd = 0.01, turn_sd = 0.002, fix_sd = 0.5, heading_sd = 0.03;
  mrpt::math::TPose2D truth{0, 0, 0};

  explicit Drive(uint64_t seed) : random(seed) {}
  double noise(double sd) { return sd * normal(random); }

  /// One step of 0.1 s, told with noise that the filter is told of.
  MotionStep advance(int i) {
    const double w = 0.4 * std::sin(0.02 * i), v = 1;
    const double distance = 0.1 * v + noise(distance_sd), turn = 0.1 * w + noise(turn_sd);
    truth = moved(truth, stepOf(0.1, distance, turn));
    const double told_distance = 0.1 * v / (1 + scale);
    const double told_turn = gyro ? 0.1 * w + bias * 0.1 : (0.1 * w - pull * told_distance) / (1 + turn_scale);
    auto told = stepOf(0.1, told_distance, told_turn, distance_sd, turn_sd);
    told.turn_from_gyro = gyro;
    return told;
  }
};

TEST(EkfCalibration, FindsHeadingOffsetGyroBiasAndWheelScale) {
  EkfParams params;
  params.heading_offset_sd = 0.5;
  params.yaw_rate_bias_sd = 0.05;
  params.wheel_scale_sd = 0.1;
  Drive drive(8);
  drive.bias = 0.02;
  drive.scale = 0.06;
  drive.offset = 0.3;
  Ekf<8> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  for (int i = 0; i < 3000; ++i) {
    ekf.predict(drive.advance(i));
    if (i % 10 == 0) {
      const double t = 1 + 0.1 * i;
      ekf.correct(fix(t, drive.truth.x + drive.noise(0.5), drive.truth.y + drive.noise(0.5), 0.5));
      ekf.correct(heading(t, drive.truth.phi + drive.offset + drive.noise(0.03), 0.03));
    }
  }
  const Whole<8> s(ekf);
  const Eigen::Vector3d truth(0.3, 0.02, 0.06), before(0.5, 0.05, 0.1);
  for (int k = 0; k < 3; ++k) {
    const double sd = std::sqrt(s.P(3 + k, 3 + k));
    EXPECT_NEAR(s.x(3 + k), truth(k), 3 * sd) << k;
    EXPECT_LT(sd, 0.1 * before(k)) << k;  // and they are known: ten times better than at the start
  }
}

TEST(EkfCalibration, FindsTheTrackAndTheUnequalWheelsOfARobotWithoutGyro) {
  EkfParams params;
  params.turn_scale_sd = 0.3;
  params.turn_pull_sd = 0.1;
  Drive drive(9);
  drive.gyro = false;
  drive.turn_scale = 0.15;
  drive.pull = -0.04;
  Ekf<8> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  for (int i = 0; i < 6000; ++i) {
    ekf.predict(drive.advance(i));
    if (i % 10 == 0)
      ekf.correct(fix(1 + 0.1 * i, drive.truth.x + drive.noise(0.5), drive.truth.y + drive.noise(0.5), 0.5));
  }
  const Whole<8> s(ekf);
  for (const auto& [k, truth, before] : {std::tuple(6, 0.15, 0.3), std::tuple(7, -0.04, 0.1)}) {
    const double sd = std::sqrt(s.P(k, k));
    EXPECT_NEAR(s.x(k), truth, 3 * sd) << k;
    EXPECT_LT(sd, 0.1 * before) << k;
  }
}

/// Mean NEES of 200 runs with noise that matches what the filter believes.
template <int N>
double meanNees() {
  EkfParams params;
  params.gate = false;
  params.heading_offset_sd = 0;
  if (N > 3) params.heading_offset_sd = 0.1;
  if (N > 4) {
    params.yaw_rate_bias_sd = 0.01;
    params.wheel_scale_sd = 0.02;
  }
  double sum = 0;
  for (uint64_t run = 0; run < 200; ++run) {
    Drive d(100 + run);
    d.offset = d.noise(params.heading_offset_sd);
    d.bias = d.noise(params.yaw_rate_bias_sd);
    d.scale = d.noise(params.wheel_scale_sd);
    d.truth = {d.noise(0.5), d.noise(0.5), d.noise(0.05)};
    Ekf<N> ekf(params);
    ekf.start(beliefOf({0, 0, 0}, 0.5, 0.05));
    for (int i = 0; i < 300; ++i) {
      ekf.predict(d.advance(i));
      if (i % 10 != 0) continue;
      ekf.correct(fix(0.1 * i, d.truth.x + d.noise(0.5), d.truth.y + d.noise(0.5), 0.5));
      ekf.correct(heading(0.1 * i, d.truth.phi + d.offset + d.noise(0.03), 0.03));
    }
    const auto b = ekf.estimate();
    const Eigen::Vector3d e(b.mean.x - d.truth.x, b.mean.y - d.truth.y, mrpt::math::wrapToPi(b.mean.phi - d.truth.phi));
    sum += e.dot(b.covariance.ldlt().solve(e));
  }
  return sum / 200;
}

// 200 runs of 3 degrees of freedom: mean 3, standard error sqrt(2 * 3 / 200) = 0.173; 3.5 of them.
TEST(EkfConsistency, HasTheErrorsThatItsCovarianceSays) { EXPECT_NEAR(meanNees<3>(), 3, 3.5 * 0.173); }
TEST(EkfConsistency, HasTheErrorsThatItsCovarianceSaysWithAHeadingOffset) {
  EXPECT_NEAR(meanNees<4>(), 3, 3.5 * 0.173);
}
TEST(EkfConsistency, HasTheErrorsThatItsCovarianceSaysWithCalibration) { EXPECT_NEAR(meanNees<8>(), 3, 3.5 * 0.173); }

TEST(EkfCalibration, IsThePlainFilterWhenNothingIsUnknown) {
  Ekf<3> plain({});
  Ekf<8> full({});
  Drive drive(9);
  plain.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  full.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  for (int i = 0; i < 1000; ++i) {
    const auto step = drive.advance(i);
    plain.predict(step);
    full.predict(step);
    if (i % 10 == 0) {
      const auto m = fix(0.1 * i, drive.truth.x + drive.noise(0.5), drive.truth.y + drive.noise(0.5), 0.5);
      EXPECT_NEAR(plain.correct(m).nis, full.correct(m).nis, 1e-9);
    }
    const auto a = plain.estimate(), b = full.estimate();
    ASSERT_NEAR(a.mean.x, b.mean.x, 1e-9);
    ASSERT_NEAR(a.mean.y, b.mean.y, 1e-9);
    ASSERT_NEAR(a.mean.phi, b.mean.phi, 1e-9);
    ASSERT_LT((a.covariance - b.covariance).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(EkfCalibration, LearnsTheBiasOfAGyroAtRest) {
  EkfParams params;
  params.yaw_rate_bias_sd = 0.03;
  Ekf<8> ekf(params);
  ekf.start(beliefOf({0, 0, 0}, 0.1, 0.1));
  Measurement still;
  still.kind = Kind::kStill;
  still.z(0) = 0.02;
  still.R(0, 0) = 0.01 * 0.01;
  EXPECT_TRUE(ekf.correct(still).accepted());
  // K = P / (P + R) = 9e-4 / (9e-4 + 1e-4) = 0.9
  EXPECT_NEAR(Whole<8>(ekf).x(4), 0.018, 1e-12);
}

TEST(MakeEkf, TakesTheSmallestFilterThatServes) {
  EkfParams known;
  known.heading_offset_sd = 0;
  EXPECT_NE(dynamic_cast<Ekf<3>*>(makeEkf(known).get()), nullptr);
  EXPECT_NE(dynamic_cast<Ekf<4>*>(makeEkf({}).get()), nullptr);
  for (double EkfParams::*sd : {&EkfParams::turn_scale_sd, &EkfParams::turn_pull_sd, &EkfParams::yaw_rate_bias_sd,
                                &EkfParams::wheel_scale_sd}) {
    EkfParams params = known;
    params.*sd = 0.1;
    EXPECT_NE(dynamic_cast<Ekf<8>*>(makeEkf(params).get()), nullptr);
  }
}

// ---- state ----

template <int N>
void expectSameContinuation() {
  EkfParams params;
  params.heading_offset_sd = params.yaw_rate_bias_sd = params.wheel_scale_sd = N > 3 ? 0.1 : 0;
  params.gate_patience_s = 5;
  Drive drive(10);
  std::vector<MotionStep> steps;
  std::vector<Measurement> fixes;
  for (int i = 0; i < 200; ++i) {
    steps.push_back(drive.advance(i));
    fixes.push_back(fix(0.1 * i, drive.truth.x + (i % 20 > 3 ? 0 : 100), drive.truth.y, 0.5));
  }
  Ekf<N> a(params), b(params);
  a.start(beliefOf({0, 0, 0}, 0.5, 0.1));
  for (size_t i = 0; i < 200; ++i) {
    if (i == 102) b.restore(saved(a));  // in the middle of refusals
    a.predict(steps[i]);
    a.correct(fixes[i]);
    if (i < 102) continue;
    b.predict(steps[i]);
    b.correct(fixes[i]);
  }
  EXPECT_EQ(saved(a), saved(b));
}

TEST(EkfState, ContinuesBitForBitAfterSaveAndRestore) {
  expectSameContinuation<3>();
  expectSameContinuation<8>();
}

}  // namespace
}  // namespace sidestep
