// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <span>

#include "core/random.h"

namespace sidestep {

/// What a sample says of the mean of what it was drawn from.
struct SampleSummary {
  size_t n = 0;
  double mean = 0;     ///< NaN if n = 0
  double sd = 0;       ///< over n - 1; NaN if n < 2
  double ci_low = 0;   ///< 95 % interval of the mean
  double ci_high = 0;  ///< both are the mean if n < 2
};

/// The interval is the percentile bootstrap of the mean (Efron 1979): 2.5 % and 97.5 % quantiles of the means of 2000
/// samples drawn with replacement. For small n it is too narrow by about sqrt((n - 1) / n). Values must be finite.
SampleSummary summarize(std::span<const double> values, Random& random);

/// Linear between the order statistics around (n - 1) q; there must be at least one.
double quantile(std::span<const double> sorted, double q);

/// Two-sided p-value of "the mean of the paired differences is zero", by flipping signs (Fisher 1935): the share of
/// sign patterns whose mean is at least as far from zero as the one seen. All 2^n patterns are counted for n <= 12;
/// beyond, 9999 are drawn, and (1 + hits) / 10000 is given, so that 0.0001 is the smallest. NaN if n = 0; 1 if all are
/// zero.
double signFlipPValue(std::span<const double> differences, Random& random);

}  // namespace sidestep
