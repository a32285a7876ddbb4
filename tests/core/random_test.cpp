// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using sidestep::Random;

TEST(Random, RepeatsItselfForTheSameSeedAndStreamOnly) {
  Random a(5, 3), b(5, 3), other_seed(6, 3), other_stream(5, 4);
  int same_seed = 0, same_stream = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = a.gaussian();
    ASSERT_EQ(x, b.gaussian());
    same_seed += x == other_seed.gaussian();
    same_stream += x == other_stream.gaussian();
  }
  EXPECT_EQ(same_seed, 0);
  EXPECT_EQ(same_stream, 0);
}

TEST(Random, GaussiansHaveTheNormalDistributionInEachPartOfIt) {
  // Counts in bins of half a sd against Phi; a bin's count is binomial, 5 standard errors allowed.
  constexpr int n = 4'000'000, bins = 20;
  Random random(1);
  std::vector<int> count(bins + 2, 0);
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.gaussian();
    sum += x;
    squares += x * x;
    ++count[static_cast<size_t>(std::clamp(std::floor(x * 2) + bins / 2 + 1, 0.0, bins + 1.0))];
  }
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2.0 / n));
  const auto phi = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  for (int k = 0; k < bins + 2; ++k) {
    const double low = k == 0 ? -std::numeric_limits<double>::infinity() : (k - 1 - bins / 2) / 2.0,
                 high = k == bins + 1 ? std::numeric_limits<double>::infinity() : (k - bins / 2) / 2.0;
    const double p = phi(high) - phi(low);
    EXPECT_NEAR(count[static_cast<size_t>(k)], n * p, 5 * std::sqrt(n * p * (1 - p)) + 1) << "bin " << k;
  }
}

TEST(Random, GaussianTailsBeyondTheLayersAreThere) {
  // P(|x| > 3.7) = 2.156e-4: beyond the ziggurat's last layer.
  constexpr int n = 4'000'000;
  Random random(2);
  int beyond = 0, positive = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.gaussian();
    beyond += std::abs(x) > 3.7;
    positive += x > 3.7;
  }
  const double expected = n * std::erfc(3.7 / std::sqrt(2.0));
  EXPECT_NEAR(beyond, expected, 5 * std::sqrt(expected));
  EXPECT_NEAR(positive, expected / 2, 5 * std::sqrt(expected / 2));
}

TEST(Random, UniformIsInsideItsBoundsAndEven) {
  Random random(3);
  std::vector<int> count(10, 0);
  for (int i = 0; i < 100000; ++i) {
    const double u = random.uniform(-1, 1);
    ASSERT_GE(u, -1);
    ASSERT_LT(u, 1);
    ++count[static_cast<size_t>((u + 1) * 5)];
  }
  for (int c : count) EXPECT_NEAR(c, 10000, 5 * std::sqrt(9000));
  for (int i = 0; i < 1000; ++i) ASSERT_LT(random.below(7), 7u);
}

TEST(Random, ABatchOfGaussiansIsTheSameNumbersOneByOne) {
  // A million, so that the edges of the layers and the tail (2.6e-4 of them) come many times.
  constexpr size_t n = 1'000'000;
  Random one(9), many(9);
  std::vector<double> batch(n);
  many.gaussians(batch.data(), n / 2 + 1);
  many.gaussians(batch.data() + n / 2 + 1, n - n / 2 - 1);
  for (size_t i = 0; i < n; ++i) ASSERT_EQ(batch[i], one.gaussian()) << i;
  EXPECT_EQ(one.bits(), many.bits());
}

TEST(Random, GoesOnFromAStateThatIsPutBack) {
  Random a(4), b(5);
  for (int i = 0; i < 10; ++i) a.gaussian();
  b.setState(a.state());
  for (int i = 0; i < 10; ++i) ASSERT_EQ(a.bits(), b.bits());
}
