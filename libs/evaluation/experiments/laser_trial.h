// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/experiments/drive.h"

namespace sidestep {

/// How a localizer in a map is put to the test with a piece of a drive.
struct LaserTrialParams {
  std::string start = "anywhere";
  double length_s = 0;
  double off_m = 0.7, off_turn = 0.1745329251994330;  // rad
  double carried_after_s = 0;
  double settle_s = 0;

  void visit(ParamVisitor& v);
};

/// A piece of a drive, and what the localizer is told of its start.
struct LaserTrial {
  RecordedDrive drive;
  std::optional<mrpt::math::TPose2D> start;  ///< none: it may be anywhere
};

/// Cuts a piece out by the seed, and splices it where the robot is carried.
/// @throws DatasetError if the drive is too short for it.
LaserTrial makeTrial(const RecordedDrive& drive, const LaserTrialParams& params, uint64_t seed);

/// An estimate beside the truth.
struct LaserSample {
  PosePair pair;         ///< time from the start of the piece [s]
  double lost_told = 0;  ///< probability of being off by more than 1 m, as the filter said
};

/// Localizes the piece. Samples are at the truth's own stamps, between two estimates at most `kMostGap_s` apart.
std::vector<LaserSample> localizeTrial(const LaserTrial& trial, const LocalizeConfig& config, uint64_t filter_seed);

/// Names of what `laserMetrics` gives:
///   mean_error_m, rmse_m, max_error_m, heading_mean_error_deg, mean_nees   from settle_s on
///   final_error_m, found      error at the end, and whether that is below 1 m (1 or 0)
///   found_after_s             when the error fell below 1 m for good; NaN if it never did
///   lost_share, lost_told     share of the samples off by more than 1 m, and the mean of what the filter said of it
///   lost_brier                mean square of the difference
///   lost_gap_1 .. lost_gap_5  sum of (said - true) over the samples where it said 0..20, 20..40 ... 80..100 %, by the
///                             number of all samples: the absolute values of their means over the runs add up to the
///                             expected calibration error
const std::vector<std::string>& laserMetricNames();
std::vector<double> laserMetrics(const std::vector<LaserSample>& samples, double settle_s);

}  // namespace sidestep
