// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/block_banded.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/random.h"

namespace sidestep {
namespace {

/// A random banded J^T J and right side, also as a dense matrix.
Eigen::MatrixXd fill(BlockBandedSystem& system, int blocks, Eigen::VectorXd& b) {
  Random random(11);
  const int n = 4 * blocks;
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(n, n);
  b = Eigen::VectorXd::Zero(n);
  system.clear(blocks);
  for (int first = 0; first + 12 <= n; first += 4) {
    Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < 12; ++i) g(first + i) = random.uniform(-1, 1);
    H += g * g.transpose();
  }
  for (int i = 0; i < n; ++i) b(i) = random.uniform(-1, 1);
  for (int k = 0; k < blocks; ++k)
    for (int i = 0; i < 4; ++i) {
      system.rhs(k)[static_cast<size_t>(i)] = b(4 * k + i);
      for (int c = 0; c < 12; ++c)
        if (const int at = 4 * (k - 2) + c; at >= 0)
          system.row(k)[static_cast<size_t>(i)][static_cast<size_t>(c)] = H(4 * k + i, at);
    }
  return H;
}

Eigen::VectorXd solutionOf(const BlockBandedSystem& system) {
  Eigen::VectorXd x(4 * system.blocks());
  for (int k = 0; k < system.blocks(); ++k)
    for (int i = 0; i < 4; ++i) x(4 * k + i) = system.solution(k)[static_cast<size_t>(i)];
  return x;
}

TEST(BlockBanded, SolvesWhatADenseFactorizationSolves) {
  for (int blocks : {3, 4, 9, 40}) {
    BlockBandedSystem system;
    Eigen::VectorXd b;
    const Eigen::MatrixXd H = fill(system, blocks, b);
    ASSERT_TRUE(system.solve(0));
    EXPECT_LT((solutionOf(system) - H.llt().solve(b)).cwiseAbs().maxCoeff(), 1e-10) << blocks;
  }
}

TEST(BlockBanded, DampingAddsToTheDiagonal) {
  BlockBandedSystem system;
  Eigen::VectorXd b;
  Eigen::MatrixXd H = fill(system, 6, b);
  ASSERT_TRUE(system.solve(0.5));
  for (int i = 0; i < H.rows(); ++i) H(i, i) += 0.5 * (H(i, i) + 1e-6);
  EXPECT_LT((solutionOf(system) - H.llt().solve(b)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(BlockBanded, AFixedVariableStaysAndTheOthersAreSolvedWithoutIt) {
  BlockBandedSystem system;
  Eigen::VectorXd b;
  Eigen::MatrixXd H = fill(system, 5, b);
  system.fix(2, 1);
  ASSERT_TRUE(system.solve(0));
  H.row(9).setZero();
  H.col(9).setZero();
  H(9, 9) = 1;
  b(9) = 0;
  EXPECT_LT((solutionOf(system) - H.llt().solve(b)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(system.solution(2)[1], 0);
}

TEST(BlockBanded, WhatIsNotPositiveDefiniteOrNotFiniteIsRefused) {
  BlockBandedSystem system;
  system.clear(3);
  EXPECT_FALSE(system.solve(0));
  Eigen::VectorXd b;
  fill(system, 3, b);
  system.row(1)[0][8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(system.solve(0));
}

}  // namespace
}  // namespace sidestep
