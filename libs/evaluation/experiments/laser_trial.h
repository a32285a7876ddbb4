// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "evaluation/experiments/drive.h"
#include "evaluation/metrics/laser_metrics.h"

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

/// Localizes the piece. Samples are at the truth's own stamps, between two estimates at most `kMostGap_s` apart.
std::vector<LaserSample> localizeTrial(const LaserTrial& trial, const LocalizeConfig& config, uint64_t filter_seed);

}  // namespace sidestep
