// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "perception/motion_predictor.h"

#include <gtest/gtest.h>

namespace sidestep {
namespace {

TEST(MotionPredictor, FindsTheVelocityOfAWalkerAndPredictsItsWay) {
  MotionPredictor predictor;
  for (int k = 0; k <= 40; ++k) predictor.observe(0.05 * k, 7, {1 + 0.8 * 0.05 * k, 2 - 0.3 * 0.05 * k}, 0.02, 0.3);
  std::vector<MovingObstacle> out;
  predictor.predict(2, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].id, 7);
  EXPECT_NEAR(out[0].velocity.x, 0.8, 0.02);
  EXPECT_NEAR(out[0].velocity.y, -0.3, 0.02);
  ASSERT_GE(out[0].predicted.size(), 4u);
  EXPECT_EQ(out[0].predicted[3].after_s, 2);
  EXPECT_NEAR(out[0].predicted[3].position.x, 1 + 0.8 * 4, 0.05);
}

TEST(MotionPredictor, TheCovarianceGrowsWithTime) {
  MotionPredictor predictor;
  for (int k = 0; k < 20; ++k) predictor.observe(0.1 * k, 1, {0, 0}, 0.05, 0.3);
  std::vector<MovingObstacle> out;
  predictor.predict(2, out);
  double before = out[0].covariance(0, 0);
  for (const auto& state : out[0].predicted) {
    EXPECT_GT(state.covariance(0, 0), before);
    before = state.covariance(0, 0);
  }
}

TEST(MotionPredictor, WhoIsNotSeenIsForgottenAndWhatIsNotFiniteIsLeftOut) {
  MotionPredictor predictor;
  predictor.observe(0, 1, {0, 0}, 0.05, 0.3);
  predictor.observe(0, 2, {std::nan(""), 0}, 0.05, 0.3);
  std::vector<MovingObstacle> out;
  predictor.predict(1, out);
  EXPECT_EQ(out.size(), 1u);
  predictor.predict(3, out);
  EXPECT_TRUE(out.empty());
}

}  // namespace
}  // namespace sidestep
