// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>

namespace sidestep {

/// By how much to raise the variance of measurements whose errors are correlated (Gauss-Markov, time constant tau =
/// `correlation_s`): to white noise of the same spectral density, 2 tau / dt; never less than 1.
/// @param period_s  time since the measurement before [s]; 0 = unknown, gives 1
inline double covarianceInflation(double correlation_s, double period_s) {
  if (!(period_s > 0)) return 1;
  return std::max(1.0, 2 * correlation_s / std::max(period_s, 1e-3));
}

}  // namespace sidestep
