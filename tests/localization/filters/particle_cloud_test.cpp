// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/particle_cloud.h"

#include <gtest/gtest.h>
#include <mrpt/poses/CPosePDFParticles.h>

#include <cmath>

#include "support/measurements.h"

namespace sidestep {
namespace {

using support::beliefOf;

ParticleCloud cloudOf(const std::vector<std::array<double, 4>>& rows) {
  ParticleCloud c;
  c.reserve(rows.size());
  c.resize(rows.size());
  for (size_t k = 0; k < rows.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    c.x[i] = rows[k][0];
    c.y[i] = rows[k][1];
    c.yaw[i] = rows[k][2];
    c.weight[i] = rows[k][3];
    c.offset[i] = 0;
  }
  return c;
}

TEST(ParticleCloud, BeliefIsTheWeightedMeanAndCovariance) {
  // By hand: x = 0.25 * 0 + 0.75 * 4 = 3, var = 0.25 * 9 + 0.75 * 1 = 3; y = 1000 + 0.75 * 2, cov xy = 0.1875 * 4 * 2
  // = 1.5.
  const auto b = cloudOf({{0, 1000, 0.1, 0.25}, {4, 1002, 0.1, 0.75}}).belief();
  EXPECT_NEAR(b.mean.x, 3, 1e-12);
  EXPECT_NEAR(b.mean.y, 1001.5, 1e-12);
  EXPECT_NEAR(b.mean.phi, 0.1, 1e-9);
  EXPECT_NEAR(b.covariance(0, 0), 3, 1e-12);
  EXPECT_NEAR(b.covariance(0, 1), 1.5, 1e-12);
  EXPECT_NEAR(b.covariance(1, 1), 0.75, 1e-12);
  EXPECT_NEAR(b.covariance(2, 2), 0, 1e-12);
}

TEST(ParticleCloud, TheMeanHeadingGoesTheShortWayRound) {
  const double a = M_PI - 0.1;
  const auto b = cloudOf({{0, 0, a, 0.5}, {0, 0, -a, 0.5}}).belief();
  EXPECT_NEAR(std::abs(b.mean.phi), M_PI, 1e-9);
  EXPECT_NEAR(b.covariance(2, 2), 0.01, 1e-9);
}

TEST(ParticleCloud, AnOddParticleCountsAsTheOthers) {
  // Mean of x = 1, 2, 3 is 2, its variance 2/3.
  const double w = 1.0 / 3;
  const auto b = cloudOf({{1, 0, 0, w}, {2, 0, 0, w}, {3, 0, 0, w}}).belief();
  EXPECT_NEAR(b.mean.x, 2, 1e-12);
  EXPECT_NEAR(b.covariance(0, 0), 2.0 / 3, 1e-12);
}

TEST(ParticleCloud, DrawsTheBeliefItIsGiven) {
  auto wanted = beliefOf({100, -50, 3}, 2, 0.1);
  wanted.covariance(0, 1) = wanted.covariance(1, 0) = 3;
  wanted.covariance(1, 2) = wanted.covariance(2, 1) = 0.1;
  ParticleCloud c;
  c.reserve(40000);
  Random random(1);
  c.draw(wanted, 40000, random);
  const auto b = c.belief();
  // Standard errors: mean 2 / 200, covariance sqrt(2) * 4 / 200 = 0.028; 5 of them.
  EXPECT_NEAR(b.mean.x, 100, 0.05);
  EXPECT_NEAR(b.mean.y, -50, 0.05);
  EXPECT_NEAR(b.mean.phi, 3, 0.0025);
  EXPECT_LT((b.covariance - wanted.covariance).cwiseAbs().maxCoeff(), 0.15);
  EXPECT_NEAR(b.covariance(1, 2), 0.1, 5 * 0.2 / 200);
}

TEST(ParticleCloud, MovesEachParticleByTheModelWithoutNoise) {
  auto c = cloudOf({{0, 0, 0, 0.5}, {1, 2, 3, 0.5}, {5, 5, -2, 0}});
  MotionStep s;
  s.dt_s = 1;
  s.distance_m = 2;
  s.turn_rad = 0.5;
  Random random(1);
  const auto before = c;
  c.move(s, {}, random);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto p = moved({before.x[i], before.y[i], before.yaw[i]}, s);
    EXPECT_NEAR(c.x[i], p.x, 1e-8);
    EXPECT_NEAR(c.y[i], p.y, 1e-8);
    EXPECT_NEAR(std::remainder(c.yaw[i] - p.phi, 2 * M_PI), 0, 1e-9);
    EXPECT_LE(std::abs(c.yaw[i]), M_PI + 1e-9);
  }
}

TEST(ParticleCloud, MotionNoiseHasTheSpreadThatIsAskedFor) {
  // Straight ahead from the origin: x varies by the distance, y by half the turn over it, yaw by both turns.
  constexpr size_t n = 40000;
  ParticleCloud c;
  c.reserve(n);
  Random random(2);
  c.draw(PoseBelief(), n, random);
  MotionStep s;
  s.dt_s = 1;
  s.distance_m = 1;
  c.move(s, {0.1, 0.02, 0.03}, random);
  const auto P = c.belief().covariance;
  const double relative = 5 * std::sqrt(2.0 / n);
  EXPECT_NEAR(P(0, 0), 0.01, 0.01 * relative);
  EXPECT_NEAR(P(1, 1), 0.0001, 0.0001 * (relative + 0.011));  // times 1 + 0.01: the distance varies too
  EXPECT_NEAR(P(2, 2), 0.0013, 0.0013 * relative);
  EXPECT_NEAR(P(1, 2), 0.0002, 0.01 * 0.036 * 5 / std::sqrt(n));
}

TEST(ParticleCloud, TwoPlacesAreTwoModesWithTheirWeights) {
  constexpr size_t n = 1000;
  ParticleCloud c;
  c.reserve(n);
  Random random(3);
  c.draw(beliefOf({0, 0, 0}, 0.1, 0.02), n, random);
  for (Eigen::Index i = 0; i < 300; ++i) {
    c.x[i] += 10;
    c.yaw[i] = 3.1;
  }
  const auto modes = c.modes(0.5, 0.35, 0.01);
  ASSERT_EQ(modes.size(), 2u);
  EXPECT_NEAR(modes[0].weight, 0.7, 1e-9);
  EXPECT_NEAR(modes[1].weight, 0.3, 1e-9);
  EXPECT_NEAR(modes[0].belief.mean.x, 0, 0.02);
  EXPECT_NEAR(modes[1].belief.mean.x, 10, 0.03);
  EXPECT_NEAR(modes[1].belief.mean.phi, 3.1, 0.01);
  EXPECT_NEAR(modes[0].belief.covariance(0, 0), 0.01, 0.003);
}

TEST(ParticleCloud, AHeadingOnBothSidesOfHalfATurnIsOneMode) {
  const auto modes = cloudOf({{0, 0, 3.1, 0.5}, {0, 0, -3.1, 0.5}}).modes(0.5, 0.35, 0.01);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_NEAR(std::abs(modes[0].belief.mean.phi), M_PI, 1e-9);
}

TEST(ParticleCloud, CrossesTheBorderToMrptWithTheSameMeanAndCovariance) {
  Random random(4);
  ParticleCloud c;
  c.reserve(500);
  c.draw(beliefOf({3, -2, 1}, 0.5, 0.1), 500, random);
  double sum = 0;
  for (Eigen::Index i = 0; i < 500; ++i) sum += c.weight[i] = random.uniform();
  c.weight /= sum;
  const auto pdf = toMrpt(c);
  mrpt::poses::CPose2D mean;
  pdf->getMean(mean);
  const auto covariance = std::get<0>(pdf->getCovarianceAndMean());
  const auto b = c.belief();
  EXPECT_NEAR(mean.x(), b.mean.x, 1e-9);
  EXPECT_NEAR(mean.y(), b.mean.y, 1e-9);
  EXPECT_NEAR(mean.phi(), b.mean.phi, 1e-3);  // MRPT's mean of angles is another one
  EXPECT_NEAR(covariance(0, 0), b.covariance(0, 0), 1e-9);
  EXPECT_NEAR(covariance(0, 1), b.covariance(0, 1), 1e-9);
}

}  // namespace
}  // namespace sidestep
