// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/resampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/errors.h"

namespace sidestep {
namespace {

const std::vector<std::string> kSchemes = {"multinomial", "systematic", "stratified", "residual"};

std::vector<uint32_t> drawn(const std::string& scheme, const std::vector<double>& weights, size_t count,
                            Random& random) {
  Resampler resampler;
  resampler.reserve(std::max(weights.size(), count));
  std::vector<uint32_t> out(count);
  resampler.draw(resamplingScheme(scheme), weights.data(), weights.size(), count, random, out.data());
  return out;
}

std::vector<double> copiesOf(const std::vector<uint32_t>& indices, size_t n) {
  std::vector<double> out(n, 0);
  for (auto i : indices) out.at(i) += 1;
  return out;
}

/// Mean copies over many draws are count * weight: unbiased, whatever the scheme.
TEST(Resampling, DrawsEachParticleInProportionToItsWeight) {
  const std::vector<double> weights = {0.05, 0.3, 0, 0.15, 0.001, 0.499};
  for (const auto& scheme : kSchemes)
    for (const size_t count : {6u, 25u}) {
      Random random(1);
      constexpr int kTimes = 20000;
      std::vector<double> sum(weights.size(), 0);
      for (int t = 0; t < kTimes; ++t) {
        const auto copies = copiesOf(drawn(scheme, weights, count, random), weights.size());
        for (size_t j = 0; j < sum.size(); ++j) sum[j] += copies[j];
      }
      for (size_t j = 0; j < sum.size(); ++j) {
        const double n = static_cast<double>(count), w = weights[j];
        // No scheme varies more than the multinomial: sd sqrt(n w (1 - w)) a draw; 5 standard errors.
        EXPECT_NEAR(sum[j] / kTimes, n * w, 5 * std::sqrt(n * w * (1 - w) / kTimes) + 1e-12) << scheme << " " << j;
      }
    }
}

TEST(Resampling, IndicesAscendAndAreComplete) {
  Random random(2);
  for (const auto& scheme : kSchemes)
    for (int t = 0; t < 200; ++t) {
      std::vector<double> weights(50);
      for (auto& w : weights) w = random.uniform() < 0.3 ? 0 : -std::log(1 - random.uniform());
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
      for (auto& w : weights) w /= sum;
      const auto indices = drawn(scheme, weights, 1 + random.below(120), random);
      EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end())) << scheme;
      for (auto i : indices) {
        ASSERT_LT(i, weights.size()) << scheme;
        EXPECT_GT(weights[i], 0) << scheme;
      }
    }
}

TEST(Resampling, EqualWeightsKeepEachParticleOnceUnlessDrawsAreIndependent) {
  const std::vector<double> weights(500, 1.0 / 500);
  for (const auto& scheme : {"systematic", "stratified", "residual"}) {
    Random random(3);
    const auto copies = copiesOf(drawn(scheme, weights, 500, random), 500);
    for (double c : copies) EXPECT_EQ(c, 1) << scheme;
  }
  // Independent draws leave out (1 - 1/n)^n = 36.75 % with a sd of about 0.31 sqrt(n) = 6.9.
  Random random(3);
  const auto copies = copiesOf(drawn("multinomial", weights, 500, random), 500);
  EXPECT_NEAR(static_cast<double>(std::count(copies.begin(), copies.end(), 0)), 183.8, 5 * 6.9);
}

TEST(Resampling, LowVarianceSchemesStayWithinOneCopyOfTheirShare) {
  const std::vector<double> weights = {0.11, 0.23, 0.07, 0.41, 0.18};
  Random random(4);
  for (int t = 0; t < 1000; ++t) {
    const auto systematic = copiesOf(drawn("systematic", weights, 20, random), 5);
    const auto residual = copiesOf(drawn("residual", weights, 20, random), 5);
    for (size_t j = 0; j < 5; ++j) {
      EXPECT_LT(std::abs(systematic[j] - 20 * weights[j]), 1);
      EXPECT_GE(residual[j], std::floor(20 * weights[j]));
    }
  }
}

TEST(Resampling, AnUnknownSchemeIsAConfigError) {
  try {
    resamplingScheme("systemic");
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_NE(std::string(e.what()).find("multinomial, systematic, stratified, residual"), std::string::npos);
  }
}

TEST(EffectiveSampleSize, IsAllForEqualWeightsAndOneForOne) {
  const std::vector<double> equal(8, 0.125), one = {0, 1, 0}, half = {0.5, 0.5, 0};
  EXPECT_DOUBLE_EQ(effectiveSampleSize(equal.data(), 8), 8);
  EXPECT_DOUBLE_EQ(effectiveSampleSize(one.data(), 3), 1);
  EXPECT_DOUBLE_EQ(effectiveSampleSize(half.data(), 3), 2);
}

TEST(KldSampleSize, IsHalfAChiSquareQuantileByTheError) {
  // chi2(0.99; 9) = 21.666 (tables); Wilson-Hilferty is within 0.2 % of it. 21.666 / (2 * 0.05) = 216.66.
  EXPECT_NEAR(kldSampleSize(10, 0.05, 2.326348), 216.66, 0.45);
  // chi2(0.99; 100) = 135.807
  EXPECT_NEAR(kldSampleSize(101, 0.05, 2.326348), 1358.07, 1);
  EXPECT_EQ(kldSampleSize(1, 0.05, 2.326348), 1);
}

TEST(CellCounter, CountsDistinctCellsOnly) {
  CellCounter cells;
  cells.reserve(100);
  for (int round = 0; round < 3; ++round) {
    EXPECT_TRUE(cells.add(0.1, 0.1, 0, 0.25, 0.1));
    EXPECT_FALSE(cells.add(0.2, 0.2, 0.05, 0.25, 0.1));
    EXPECT_TRUE(cells.add(-0.1, 0.2, 0.05, 0.25, 0.1));
    EXPECT_TRUE(cells.add(0.1, 0.1, -0.05, 0.25, 0.1));
    for (int i = 0; i < 97; ++i) EXPECT_TRUE(cells.add(10 + i, -i, 0, 0.25, 0.1));
    EXPECT_EQ(cells.count(), 100u);
    cells.clear();
    EXPECT_EQ(cells.count(), 0u);
  }
}

}  // namespace
}  // namespace sidestep
