// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "evaluation/metrics/metric.h"
#include "evaluation/metrics/trajectory_error.h"

namespace sidestep {

/// An estimate beside the truth.
struct LaserSample {
  PosePair pair;         ///< time from the start of the piece [s]
  double lost_told = 0;  ///< probability of being off by more than 1 m, as the filter said
};

/// What a trial of a localizer in a map adds up to.
struct LaserNumbers {
  TrajectoryErrors settled;  ///< errors from settle_s on
  double final_error_m = NAN, found_after_s = NAN;
  double lost_share = 0, lost_told = 0, lost_brier = 0;
  static constexpr size_t kGaps = 5;
  std::array<double, kGaps> lost_gaps{};
};
LaserNumbers measureTrial(const std::vector<LaserSample>& samples, double settle_s);

/// The rows of studies of kind `laser`.
const Metrics<LaserNumbers>& laserMetrics();

}  // namespace sidestep
