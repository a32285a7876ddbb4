// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace sidestep {

/// Positive definite systems H x = b of 4 x 4 blocks, where block row k reaches back to k - 2 at most: what a band
/// makes, since an acceleration sees three poses. Factor and solve are linear in the number of blocks. Memory is kept.
class BlockBandedSystem {
 public:
  static constexpr int kBlock = 4, kReach = 2, kWidth = kBlock * (kReach + 1);
  using Vector = std::array<double, kBlock>;
  /// Columns of blocks k - 2, k - 1 and k, in this order; the upper triangle of the last is not read.
  using Row = std::array<std::array<double, kWidth>, kBlock>;

  /// All zero, for `blocks` block rows.
  void clear(int blocks);
  int blocks() const { return blocks_; }

  Row& row(int k) { return rows_[static_cast<size_t>(k)]; }
  Vector& rhs(int k) { return rhs_[static_cast<size_t>(k)]; }
  const Vector& rhs(int k) const { return rhs_[static_cast<size_t>(k)]; }
  const Vector& solution(int k) const { return solution_[static_cast<size_t>(k)]; }

  /// Variable `i` of block k stays as it is: its row and column are those of the identity, its right side 0.
  void fix(int k, int i);

  /// Solves (H + lambda (diag(H) + 1e-6 I)) x = b by a banded Cholesky factorization; H and b are kept.
  /// @return false if that matrix is not positive definite, or not finite
  bool solve(double lambda);

 private:
  bool factorRow(int k, double lambda);
  void forward(int k);
  void backward(int k);

  int blocks_ = 0;
  std::vector<Row> rows_, factor_;
  std::vector<Vector> rhs_, solution_, inverse_diagonal_;
};

}  // namespace sidestep
