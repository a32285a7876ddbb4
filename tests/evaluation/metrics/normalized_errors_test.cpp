// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/normalized_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "evaluation/metrics/consistency.h"

namespace sidestep {
namespace {

/// n errors of unit sd times `sd`, each component correlated as exp(-lag / length), by a covariance of unit sd.
NormalizedErrors correlated(uint64_t seed, size_t n, double length, double sd) {
  Random random(seed);
  const double keep = length > 0 ? std::exp(-1 / length) : 0;
  Eigen::Vector3d e;
  for (int k = 0; k < 3; ++k) e(k) = sd * random.gaussian();
  NormalizedErrors out;
  for (size_t t = 0; t < n; ++t) {
    out.add(static_cast<double>(t), e, Eigen::Matrix3d::Identity(), true);
    for (int k = 0; k < 3; ++k) e(k) = keep * e(k) + sd * std::sqrt(1 - keep * keep) * random.gaussian();
  }
  return out;
}

TEST(NormalizedErrors, WeighsByTheCovariance) {
  NormalizedErrors e;
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  P.diagonal() << 4, 9, 0.25;
  e.add(0, {2, 3, 0.5}, P, true);  // 1 + 1 + 1
  EXPECT_NEAR(e.meanNees().value(), 3, 1e-12);
  EXPECT_EQ(e.dof(), 3);
  e.add(1, {9, 9, 9}, Eigen::Matrix3d::Zero(), true);  // says nothing
  EXPECT_EQ(e.count(), 1u);
}

TEST(NormalizedErrors, IndependentOnesCountInFull) {
  const auto e = correlated(1, 400, 0, 1);
  EXPECT_GT(e.effectiveCount(), 300);
  EXPECT_LE(e.effectiveCount(), 400);
}

TEST(NormalizedErrors, CorrelatedOnesCountLess) {
  // rho^2 = exp(-2 l / 10): tau = 1 + 2 / (e^0.2 - 1) = 10.03, so that 400 are worth 40. The noise of C(l) counts as
  // correlation, which makes it some fewer: on the cautious side.
  double sum = 0;
  for (uint64_t seed = 0; seed < 100; ++seed) sum += correlated(seed, 400, 10, 1).effectiveCount();
  EXPECT_GT(sum / 100, 25);
  EXPECT_LT(sum / 100, 42);
}

TEST(NormalizedErrors, AnErrorThatStaysIsWorthOneOrTwo) {
  NormalizedErrors e;
  for (int t = 0; t < 1000; ++t) e.add(t, {1, -1, 0.5}, Eigen::Matrix3d::Identity(), true);
  EXPECT_LT(e.effectiveCount(), 2);
}

TEST(NormalizedErrors, ThinningKeepsTheMeanOfAll) {
  const auto e = correlated(2, 5000, 20, 1);
  EXPECT_EQ(e.count(), 5000u);
  EXPECT_LT(e.kept().size(), 500u);
  EXPECT_NEAR(e.meanNees().value(), 3, 6 * std::sqrt(6 * 20.0 / 5000));
}

TEST(Nees, MatchedErrorsPassAtNinetyFivePercentHoweverAlikeNeighboursAre) {
  // 1000 runs, standard error of the share 0.007. What is known of tau is from the run itself, hence the wider bounds.
  for (const double length : {0.0, 3.0, 20.0, 100.0}) {
    int consistent = 0;
    for (uint64_t seed = 0; seed < 1000; ++seed) {
      const auto e = correlated(seed, 400, length, 1);
      consistent += judgeNees(*e.meanNees(), e.effectiveCount(), 3).verdict == "consistent";
    }
    EXPECT_GE(consistent, 915) << length;
    EXPECT_LE(consistent, 985) << length;
  }
}

TEST(Nees, ErrorsOfThreeTimesTheSdAreNamed) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    const auto large = correlated(seed, 400, 10, 3), small = correlated(seed, 400, 10, 1.0 / 3);
    const auto bold = judgeNees(*large.meanNees(), large.effectiveCount(), 3);
    const auto shy = judgeNees(*small.meanNees(), small.effectiveCount(), 3);
    ASSERT_EQ(bold.verdict, "over-confident");
    ASSERT_NEAR(bold.sd_factor, 3, 1);
    ASSERT_EQ(shy.verdict, "too cautious");
    ASSERT_NEAR(shy.sd_factor, 1.0 / 3, 0.11);
  }
}

TEST(Nees, BandIsTheChiSquares) {
  // chi-square of 30 degrees: 2.5 % and 97.5 % quantiles are 16.791 and 46.979
  const auto b = neesBand(10, 3);
  EXPECT_NEAR(b.low, 1.6791, 0.002);
  EXPECT_NEAR(b.high, 4.6979, 0.002);
}

}  // namespace
}  // namespace sidestep
