// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/trajectory_error.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>
#include <random>

namespace sidestep {
namespace {

using mrpt::math::TPose2D;
constexpr double kPi = std::numbers::pi;

/// Point i of a quarter circle of 10 m.
TPose2D onCircle(int i) {
  const double a = 0.01 * i;
  return {10 * std::cos(a), 10 * std::sin(a), a + kPi / 2};
}

PosePair makePair(const TPose2D& estimate, const TPose2D& truth) {
  PosePair pair;
  pair.estimate = estimate;
  pair.truth = truth;
  return pair;
}

TEST(TrajectoryErrorMeter, GivesZerosWithoutSamples) {
  const TrajectoryErrorMeter meter;
  const auto errors = meter.measure(Alignment::kLeastSquares);
  EXPECT_EQ(errors.samples, 0u);
  EXPECT_EQ(errors.rmse_m, 0);
  EXPECT_FALSE(errors.mean_nees);
}

TEST(TrajectoryErrorMeter, SeesAConstantOffsetAsMeanWithoutSpread) {
  TrajectoryErrorMeter meter;
  for (int i = 0; i < 150; ++i) {
    TPose2D shifted = onCircle(i);
    shifted.x += 3, shifted.y -= 4, shifted.phi += 0.1;
    meter.add(makePair(shifted, onCircle(i)));
  }
  const auto errors = meter.measure(Alignment::kNone);
  EXPECT_EQ(errors.samples, 150u);
  EXPECT_NEAR(errors.mean_error_m, 5, 1e-12);  // hypot(3, 4) at each sample
  EXPECT_NEAR(errors.mean_square_error_m2, 0, 1e-12);
  EXPECT_NEAR(errors.rmse_m, 5, 1e-12);
  EXPECT_NEAR(errors.final_error_m, 5, 1e-12);
  EXPECT_NEAR(errors.heading_mean_error_deg, 0.1 * 180 / kPi, 1e-9);
}

TEST(TrajectoryErrorMeter, TellsTheSpreadFromTheMeanOfSquares) {
  TrajectoryErrorMeter meter;
  meter.add(makePair({1, 0, 0}, {0, 0, 0}));
  meter.add(makePair({0, 3, 0}, {0, 0, 0}));
  const auto errors = meter.measure(Alignment::kNone);
  EXPECT_NEAR(errors.mean_error_m, 2, 1e-15);          // (1 + 3) / 2
  EXPECT_NEAR(errors.mean_square_error_m2, 1, 1e-15);  // ((1-2)^2 + (3-2)^2) / 2
  EXPECT_NEAR(errors.rmse_m, std::sqrt(5.0), 1e-15);   // sqrt((1 + 9) / 2)
  EXPECT_EQ(errors.max_error_m, 3);
  EXPECT_EQ(errors.final_error_m, 3);
}

TEST(TrajectoryErrorMeter, FindsARigidTransformByLeastSquares) {
  const TPose2D T(5, -7, 2.5);
  TrajectoryErrorMeter meter;
  for (int i = 0; i < 150; ++i) meter.add(makePair(onCircle(i), T + onCircle(i)));
  const auto errors = meter.measure(Alignment::kLeastSquares);
  EXPECT_EQ(errors.alignment, Alignment::kLeastSquares);
  EXPECT_NEAR(errors.T_truth_estimate.x, 5, 1e-9);
  EXPECT_NEAR(errors.T_truth_estimate.y, -7, 1e-9);
  EXPECT_NEAR(errors.T_truth_estimate.phi, 2.5, 1e-9);
  EXPECT_NEAR(errors.max_error_m, 0, 1e-9);
  EXPECT_NEAR(errors.heading_mean_error_deg, 0, 1e-7);
}

TEST(TrajectoryErrorMeter, MapsTheFirstEstimateOntoTheFirstTruth) {
  // Estimate runs along x, truth along y and twice as far: after the turn by 90 deg the end is 10 m short.
  TrajectoryErrorMeter meter;
  for (int i = 0; i <= 10; ++i) meter.add(makePair({1.0 * i, 0, 0}, {3, 2.0 * i, kPi / 2}));
  const auto errors = meter.measure(Alignment::kFirstPose);
  EXPECT_NEAR(errors.T_truth_estimate.x, 3, 1e-12);
  EXPECT_NEAR(errors.T_truth_estimate.phi, kPi / 2, 1e-12);
  EXPECT_NEAR(errors.final_error_m, 10, 1e-12);
  EXPECT_NEAR(errors.mean_error_m, 5, 1e-12);
}

TEST(TrajectoryErrorMeter, FallsBackToTheFirstPoseWhenNothingMoves) {
  TrajectoryErrorMeter meter;
  for (int i = 0; i < 3; ++i) meter.add(makePair({1, 2, 0}, {4, 6, kPi / 2}));
  const auto errors = meter.measure(Alignment::kLeastSquares);
  EXPECT_EQ(errors.alignment, Alignment::kFirstPose);
  EXPECT_NEAR(errors.max_error_m, 0, 1e-12);
  EXPECT_NEAR(errors.heading_mean_error_deg, 0, 1e-12);
}

TEST(TrajectoryErrorMeter, WrapsTheHeadingError) {
  TrajectoryErrorMeter meter;
  meter.add(makePair({0, 0, kPi - 0.01}, {0, 0, -kPi + 0.01}));
  EXPECT_NEAR(meter.measure(Alignment::kNone).heading_mean_error_deg, 0.02 * 180 / kPi, 1e-9);
}

TEST(TrajectoryErrorMeter, WithoutATrueHeadingNeesIsOfThePositionAlone) {
  TrajectoryErrorMeter meter;
  PosePair pair = makePair({1, 0, 3}, {0, 0, 0});
  pair.covariance.setIdentity();
  pair.has_heading = false;
  meter.add(pair);
  const auto errors = meter.measure(Alignment::kNone);
  EXPECT_EQ(errors.heading_samples, 0u);
  EXPECT_EQ(errors.mean_nees, 1);
  EXPECT_EQ(errors.nees.dof(), 2);
  EXPECT_EQ(errors.mean_error_m, 1);
}

TEST(TrajectoryErrorMeter, LeavesOutCovariancesThatCannotBeInverted) {
  TrajectoryErrorMeter meter;
  PosePair pair = makePair({2, 0, 0}, {0, 0, 0});
  pair.covariance.diagonal() << 1, 1, -1;
  meter.add(pair);
  EXPECT_FALSE(meter.measure(Alignment::kNone).mean_nees);
  pair.covariance.diagonal() << 4, 1, 1;
  meter.add(pair);
  EXPECT_NEAR(meter.measure(Alignment::kNone).mean_nees.value(), 1, 1e-12);  // 2^2 / 4
}

TEST(TrajectoryErrorMeter, TurnsTheCovarianceWithTheAlignment) {
  // Frames differ by 90 deg: the second error lies along the estimate's x axis, whose variance is 4, so NEES = 2^2 / 4;
  // the first pair is exact and counts 0.
  TrajectoryErrorMeter meter;
  PosePair pair = makePair({0, 0, 0}, {0, 0, kPi / 2});
  pair.covariance.diagonal() << 4, 0.01, 1;
  meter.add(pair);
  pair.estimate.x = 2;
  meter.add(pair);
  EXPECT_NEAR(meter.measure(Alignment::kFirstPose).mean_nees.value(), 0.5, 1e-9);
}

TEST(TrajectoryErrorMeter, FindsThreeAsMeanNeesOfMatchedNoise) {
  Eigen::Matrix3d P;
  P << 0.09, 0.02, 0.001, 0.02, 0.04, -0.002, 0.001, -0.002, 0.0025;
  const Eigen::Matrix3d L = P.llt().matrixL();
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  TrajectoryErrorMeter meter;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const double a = normal(random), b = normal(random), c = normal(random);
    const Eigen::Vector3d e = L * Eigen::Vector3d(a, b, c);
    const TPose2D truth = onCircle(i);
    PosePair pair = makePair({truth.x + e.x(), truth.y + e.y(), truth.phi + e.z()}, truth);
    pair.covariance = P;
    meter.add(pair);
  }
  // chi square with 3 degrees of freedom: mean 3, variance 6; standard error sqrt(6 / n), four of them allowed.
  EXPECT_NEAR(meter.measure(Alignment::kNone).mean_nees.value(), 3, 4 * std::sqrt(6.0 / kSamples));
}

TEST(TrajectoryErrorMeter, CanBeFedOnAfterAMeasurement) {
  TrajectoryErrorMeter meter;
  meter.add(makePair({1, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(meter.measure(Alignment::kNone).mean_error_m, 1);
  meter.add(makePair({3, 0, 0}, {0, 0, 0}));
  EXPECT_EQ(meter.measure(Alignment::kNone).mean_error_m, 2);
  EXPECT_EQ(meter.samples(), 2u);
}

TEST(TrajectoryErrorMeter, KeepsItsDigitsFarFromTheOrigin) {
  // UTM-like coordinates: rounding of 4e6 is 5e-10, so the transform of the shifted circle must fit to nanometres.
  TrajectoryErrorMeter meter;
  for (int i = 0; i < 1000; ++i) {
    const TPose2D p = onCircle(i);
    meter.add(makePair({p.x + 4e6, p.y + 4e6, p.phi}, p));
  }
  EXPECT_LT(meter.measure(Alignment::kLeastSquares).max_error_m, 1e-8);
}

}  // namespace
}  // namespace sidestep
