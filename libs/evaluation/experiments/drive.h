// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "datasets/ground_truth.h"
#include "evaluation/metrics/trajectory_error.h"
#include "localization/configuration.h"
#include "simulation/localization_scenario.h"

namespace sidestep {

/// A stretch of time in which signals do not arrive: theta is the IMU, xy the position fixes.
struct SignalLoss {
  bool theta = false, xy = false;
  double from_s = 0, to_s = 0;  ///< after the start of the drive [s]

  bool any() const { return (theta || xy) && to_s > from_s; }
  bool covers(double time_s) const { return time_s >= from_s && time_s < to_s; }
};

/// NIS of all measurements of one kind that were accepted.
struct KindNis {
  std::string kind;  ///< a sensor's word: "gps", "imu", ...
  double sum = 0;
  double count = 0, independent = 0;
  int dof = 0;
};

/// What a localizer made of a drive.
struct DriveResult {
  std::vector<PosePair> pairs;                ///< time from the start of the drive [s], in the order of time
  std::vector<mrpt::math::TPose2D> odometry;  ///< beside each pair, from the same start
  std::vector<mrpt::math::TPoint2D> fixes;
  std::vector<SensorUse> sensors;  ///< what became of the readings
  bool aligned = false;            ///< laid onto the truth: NEES judges nothing
  std::vector<KindNis> nis;
  std::optional<double> gate_probability;  ///< LocalizeConfig::gateProbability
};

/// Localizes one seeded run of a simulated drive.
DriveResult localizeSimulated(const LocalizationScenario& scenario, const LocalizeConfig& config,
                              const SignalLoss& loss, uint64_t world_seed, uint64_t filter_seed);

/// A recorded drive, held in memory so that it can be localized many times.
struct RecordedDrive {
  std::string file;
  std::vector<Reading> entries;    ///< of sensors only
  std::vector<StampedPose> truth;  ///< in the log's time
  double start_s = 0, duration_s = 0;
};

/// The kinds of readings that any of the configurations uses.
std::vector<SensorKind> kindsUsedBy(const std::vector<LocalizeConfig>& configs);

/// @param truth_file  empty: the log's own truth
/// @param keeps  the kinds of readings that are kept, besides the truth
/// @throws DatasetError if the log or its truth cannot be read whole.
RecordedDrive readDrive(const std::string& log, const std::string& truth_file, const std::vector<std::string>& labels,
                        const std::vector<SensorKind>& keeps);

/// Localizes a recorded drive; pairs are where there is truth.
DriveResult localizeRecorded(const RecordedDrive& drive, const LocalizeConfig& config, const SignalLoss& loss,
                             uint64_t filter_seed);

}  // namespace sidestep
