// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_histogram.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

size_t LogHistogram::bin(double value) {
  const double at = (std::log10(std::max(value, 1e-6)) + 6) * kPerDecade;
  return static_cast<size_t>(std::clamp(at, 0.0, kPerDecade * kDecades - 1.0));
}

void LogHistogram::add(double value) {
  const size_t i = bin(value);
  ++counts_[i];
  sums_[i] += value;
  ++count_;
}

double LogHistogram::quantile(double fraction) const {
  const double wanted = fraction * static_cast<double>(count_);
  double below = 0;
  for (size_t i = 0; i < counts_.size(); ++i) {
    below += static_cast<double>(counts_[i]);
    if (counts_[i] > 0 && below >= wanted) return sums_[i] / static_cast<double>(counts_[i]);
  }
  return 0;
}

uint64_t LogHistogram::countAbove(double limit) const {
  uint64_t n = 0;
  for (size_t i = bin(limit) + 1; i < counts_.size(); ++i) n += counts_[i];
  return n;
}

}  // namespace sidestep
