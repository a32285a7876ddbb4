// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/block_banded.h"

#include <cmath>

namespace sidestep {
namespace {

constexpr int kB = BlockBandedSystem::kBlock;
constexpr double kFloor = 1e-6;  ///< of the diagonal that is damped, so that a free variable is damped too

using Row = BlockBandedSystem::Row;
using Vector = BlockBandedSystem::Vector;

/// X <- X L^-T on the columns at `at` of `row`, where L is the last block of `of`.
void solveRight(Row& row, int at, const Row& of, const Vector& inverse_diagonal) {
  constexpr int kLast = 2 * kB;
  for (int j = 0; j < kB; ++j)
    for (int i = 0; i < kB; ++i) {
      double x = row[i][at + j];
      for (int m = 0; m < j; ++m) x -= row[i][at + m] * of[j][kLast + m];
      row[i][at + j] = x * inverse_diagonal[j];
    }
}

/// to -= A B^T, blocks at their columns.
void subtractProduct(Row& to, int to_at, const Row& a, int a_at, const Row& b, int b_at) {
  for (int i = 0; i < kB; ++i)
    for (int j = 0; j < kB; ++j) {
      double sum = 0;
      for (int m = 0; m < kB; ++m) sum += a[i][a_at + m] * b[j][b_at + m];
      to[i][to_at + j] -= sum;
    }
}

/// Cholesky of the last block, in place. @return false if a pivot is not positive
bool factorLast(Row& row, Vector& inverse_diagonal) {
  constexpr int kLast = 2 * kB;
  for (int j = 0; j < kB; ++j) {
    double pivot = row[j][kLast + j];
    for (int m = 0; m < j; ++m) pivot -= row[j][kLast + m] * row[j][kLast + m];
    if (!(pivot > 0) || !std::isfinite(pivot)) return false;
    inverse_diagonal[j] = 1 / std::sqrt(pivot);
    for (int i = j + 1; i < kB; ++i) {
      double x = row[i][kLast + j];
      for (int m = 0; m < j; ++m) x -= row[i][kLast + m] * row[j][kLast + m];
      row[i][kLast + j] = x * inverse_diagonal[j];
    }
  }
  return true;
}

}  // namespace

void BlockBandedSystem::clear(int blocks) {
  blocks_ = blocks;
  const auto n = static_cast<size_t>(blocks);
  rows_.assign(n, Row{});
  rhs_.assign(n, Vector{});
  factor_.resize(n);
  solution_.resize(n);
  inverse_diagonal_.resize(n);
}

void BlockBandedSystem::fix(int k, int i) {
  for (auto& h : row(k)[i]) h = 0;
  for (int r = 0; r < kB; ++r) row(k)[r][2 * kB + i] = 0;
  for (int ahead = 1; ahead <= kReach && k + ahead < blocks_; ++ahead)
    for (int r = 0; r < kB; ++r) row(k + ahead)[r][(kReach - ahead) * kB + i] = 0;
  row(k)[i][2 * kB + i] = 1;
  rhs(k)[i] = 0;
}

bool BlockBandedSystem::factorRow(int k, double lambda) {
  const auto at = static_cast<size_t>(k);
  Row& row = factor_[at];
  row = rows_[at];
  for (int i = 0; i < kB; ++i) row[i][2 * kB + i] += lambda * (row[i][2 * kB + i] + kFloor);
  if (k >= 2) {
    solveRight(row, 0, factor_[at - 2], inverse_diagonal_[at - 2]);
    subtractProduct(row, kB, row, 0, factor_[at - 1], kB);
    subtractProduct(row, 2 * kB, row, 0, row, 0);
  }
  if (k >= 1) {
    solveRight(row, kB, factor_[at - 1], inverse_diagonal_[at - 1]);
    subtractProduct(row, 2 * kB, row, kB, row, kB);
  }
  return factorLast(row, inverse_diagonal_[at]);
}

void BlockBandedSystem::forward(int k) {
  const auto at = static_cast<size_t>(k);
  const Row& row = factor_[at];
  Vector x = rhs_[at];
  for (int i = 0; i < kB; ++i) {
    if (k >= 2)
      for (int m = 0; m < kB; ++m) x[i] -= row[i][m] * solution_[at - 2][m];
    if (k >= 1)
      for (int m = 0; m < kB; ++m) x[i] -= row[i][kB + m] * solution_[at - 1][m];
  }
  for (int i = 0; i < kB; ++i) {
    for (int m = 0; m < i; ++m) x[i] -= row[i][2 * kB + m] * x[m];
    x[i] *= inverse_diagonal_[at][i];
  }
  solution_[at] = x;
}

void BlockBandedSystem::backward(int k) {
  const auto at = static_cast<size_t>(k);
  Vector x = solution_[at];
  const Row& row = factor_[at];
  for (int i = kB - 1; i >= 0; --i) {
    for (int m = i + 1; m < kB; ++m) x[i] -= row[m][2 * kB + i] * x[m];
    x[i] *= inverse_diagonal_[at][i];
  }
  solution_[at] = x;
  for (int back = 1; back <= kReach && back <= k; ++back)
    for (int i = 0; i < kB; ++i)
      for (int m = 0; m < kB; ++m)
        solution_[at - static_cast<size_t>(back)][i] -= row[m][(kReach - back) * kB + i] * x[m];
}

bool BlockBandedSystem::solve(double lambda) {
  for (int k = 0; k < blocks_; ++k) {
    if (!factorRow(k, lambda)) return false;
    forward(k);
  }
  for (int k = blocks_ - 1; k >= 0; --k) backward(k);
  for (const auto& x : solution_)
    for (double value : x)
      if (!std::isfinite(value)) return false;
  return true;
}

}  // namespace sidestep
