// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sidestep {
namespace {

TEST(Statistics, MeanAndDeviationAreThoseOfTheSample) {
  Random random(1);
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};  // mean 5, squares sum 32, 32 / 7
  const auto s = summarize(values, random);
  EXPECT_EQ(s.n, 8u);
  EXPECT_DOUBLE_EQ(s.mean, 5);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(32.0 / 7));
  EXPECT_LT(s.ci_low, s.mean);
  EXPECT_GT(s.ci_high, s.mean);
}

/// For n large the bootstrap of the mean is normal: mean -+ 1.96 sd sqrt((n-1)/n) / sqrt(n). The quantiles of 2000
/// resamples scatter by about sd / sqrt(n) sqrt(p (1-p) / 2000) / f = 0.06 of a standard error; four of that.
TEST(Statistics, TheIntervalOfALargeSampleIsTheNormalOne) {
  Random random(2);
  std::vector<double> values(400);
  for (auto& v : values) v = random.gaussian(3, 2);
  const auto s = summarize(values, random);
  const double error = s.sd / std::sqrt(400.0);
  EXPECT_NEAR(s.ci_low, s.mean - 1.96 * error, 0.24 * error);
  EXPECT_NEAR(s.ci_high, s.mean + 1.96 * error, 0.24 * error);
}

/// 95 % of the intervals hold the true mean: of 400, 380 -+ 4 sqrt(400 * 0.95 * 0.05) = 17, and 8 less because the
/// percentile interval of n = 30 is too narrow by 1.7 % (1.7 % of a width of 3.92 sd, at a density of 0.058 a side).
TEST(Statistics, TheIntervalHoldsTheTrueMeanAsOftenAsItSays) {
  Random random(3);
  int held = 0;
  for (int k = 0; k < 400; ++k) {
    std::vector<double> values(30);
    for (auto& v : values) v = random.gaussian(1, 1);
    const auto s = summarize(values, random);
    held += s.ci_low <= 1 && 1 <= s.ci_high ? 1 : 0;
  }
  EXPECT_GE(held, 380 - 17 - 8);
  EXPECT_LE(held, 380 + 17);
}

TEST(Statistics, ASampleOfOneHasNoSpread) {
  Random random(1);
  const auto s = summarize(std::vector<double>{7}, random);
  EXPECT_EQ(s.mean, 7);
  EXPECT_EQ(s.ci_low, 7);
  EXPECT_EQ(s.ci_high, 7);
  EXPECT_TRUE(std::isnan(s.sd));
  EXPECT_TRUE(std::isnan(summarize({}, random).mean));
}

/// Of the 8 sign patterns of three differences alike, only +++ and --- are as far from zero.
TEST(Statistics, FewDifferencesAreCountedExactly) {
  Random random(1);
  EXPECT_DOUBLE_EQ(signFlipPValue(std::vector<double>{1, 1, 1}, random), 0.25);
  EXPECT_DOUBLE_EQ(signFlipPValue(std::vector<double>{-0.1, -0.1, -0.1}, random), 0.25);
  // 1, 2, 3: sums +-6, +-4, +-2, 0, 0; the one seen is 4 = -1 + 2 + 3, so 6, 4 and their mirrors: 4 of 8.
  EXPECT_DOUBLE_EQ(signFlipPValue(std::vector<double>{-1, 2, 3}, random), 0.5);
  EXPECT_DOUBLE_EQ(signFlipPValue(std::vector<double>{0, 0}, random), 1);
  EXPECT_TRUE(std::isnan(signFlipPValue({}, random)));
}

/// Twenty differences of which 15 are +1 and 5 are -1: the p-value is that of the binomial, 2 P(X >= 15) = 0.0414.
/// Of 9999 drawn patterns the share scatters by sqrt(p (1-p) / 9999) = 0.002.
TEST(Statistics, ManyDifferencesAreCountedByDrawing) {
  Random random(5);
  std::vector<double> d(20, 1.0);
  for (size_t i = 0; i < 5; ++i) d[i] = -1;
  EXPECT_NEAR(signFlipPValue(d, random), 0.0414, 0.008);
  const std::vector<double> sure(100, 0.5);
  EXPECT_DOUBLE_EQ(signFlipPValue(sure, random), 1e-4);
}

TEST(Statistics, TheSameSeedGivesTheSameBits) {
  const std::vector<double> values = {0.1, 0.7, 0.3, 0.9, 0.25};
  Random a(9, 4), b(9, 4);
  const auto x = summarize(values, a), y = summarize(values, b);
  EXPECT_EQ(x.ci_low, y.ci_low);
  EXPECT_EQ(x.ci_high, y.ci_high);
}

}  // namespace
}  // namespace sidestep
