// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace sidestep {

/// Quantiles of positive numbers between 1e-6 and 1e6 in fixed memory, to about 5 %: counts in logarithmic bins, and
/// the mean within each.
class LogHistogram {
 public:
  void add(double value);
  /// The mean of the bin in which `fraction` of the values lie below; 0 if there is none.
  double quantile(double fraction) const;
  /// How many values lie in bins beyond the one of `limit`.
  uint64_t countAbove(double limit) const;
  uint64_t count() const { return count_; }

 private:
  static constexpr int kPerDecade = 50, kDecades = 12;
  static size_t bin(double value);
  std::array<uint64_t, kPerDecade * kDecades> counts_{};
  std::array<double, kPerDecade * kDecades> sums_{};
  uint64_t count_ = 0;
};

}  // namespace sidestep
