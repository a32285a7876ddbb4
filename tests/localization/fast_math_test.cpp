// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/fast_math.h"

#include <gtest/gtest.h>

namespace sidestep {
namespace {

TEST(FastMath, SineAndCosineAreThoseOfTheLibrary) {
  for (int i = -200000; i <= 200000; ++i) {
    const double a = i * 1e-4 * M_PI;  // to 20 pi, quarter turns among them
    double s, c;
    sineCosine(a, s, c);
    ASSERT_NEAR(s, std::sin(a), 1e-9) << a;
    ASSERT_NEAR(c, std::cos(a), 1e-9) << a;
  }
}

TEST(FastMath, PairsGiveTheSameBitsAsSingleNumbers) {
  for (int i = 0; i < 1000; ++i) {
    const Pair a(0.013 * i - 5, 1.7 - 0.029 * i);
    Pair s, c;
    sineCosine<Pair>(a, s, c);
    const Pair w = wrapAngle<Pair>(a);
    for (int k = 0; k < 2; ++k) {
      double sine, cosine;
      sineCosine(a(k), sine, cosine);
      ASSERT_EQ(s(k), sine);
      ASSERT_EQ(c(k), cosine);
      ASSERT_EQ(w(k), wrapAngle(a(k)));
    }
  }
}

TEST(FastMath, WrappedAnglesPointTheSameWayInsideHalfATurn) {
  for (int i = -5000; i <= 5000; ++i) {
    const double a = 0.01 * i, w = wrapAngle(a);
    ASSERT_LE(std::abs(w), M_PI + 1e-12);
    ASSERT_NEAR(std::remainder(a - w, 2 * M_PI), 0, 1e-12);
  }
}

TEST(FastMath, WeightsAreExponentialsDownToTheLeastOne) {
  for (int i = 0; i <= 70000; ++i) {
    const double a = -0.01 * i;
    ASSERT_NEAR(weightExp(a) / std::exp(a), 1, 2e-9) << a;
  }
  EXPECT_NEAR(weightExp(-1e9) / std::exp(-700.0), 1, 2e-9);
  EXPECT_EQ(weightExp(0), 1);
}

TEST(FastMath, PairsVisitEachPlaceOnceAndTheOddOneAlone) {
  for (const Eigen::Index n : {0, 1, 2, 7, 8}) {
    Eigen::ArrayXd a = Eigen::ArrayXd::LinSpaced(n, 1, static_cast<double>(n));
    PairSum sum;
    forPairs(n, [&](Eigen::Index i, auto lane) { sum.add(at(a.data(), i, lane)); });
    EXPECT_EQ(sum.total(), static_cast<double>(n * (n + 1) / 2));
  }
}

}  // namespace
}  // namespace sidestep
