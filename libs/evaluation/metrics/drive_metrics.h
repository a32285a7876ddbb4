// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "evaluation/experiments/drive.h"
#include "evaluation/metrics/metric.h"

namespace sidestep {

/// What a run of a drive adds up to; NaN where something is not defined.
struct DriveNumbers {
  struct Ratio {
    double mean = NAN;     ///< by what a consistent filter has
    double in_band = NAN;  ///< 1 if the run's own 95 % interval holds 1, else 0
  };
  TrajectoryErrors errors;
  Ratio nees;
  std::map<std::string, Ratio> nis;  ///< by kind of sensor
  double outage_error_m = NAN, outage_end_error_m = NAN, outage_added_m = NAN, recovery_s = NAN, recovered = NAN;
};

/// The rows of studies of kind `localization`. Dead reckoning has no run without the loss to compare with: its
/// `outage_added_m`, `recovery_s` and `recovered` are NaN.
const Metrics<DriveNumbers>& driveMetrics();

/// Errors of a drive, by time.
struct DriveErrors {
  std::vector<double> time_s, error_m;
};
DriveErrors errorsOf(const DriveResult& result);

/// @param twin      of the same run without a loss; used if there is one
/// @param loss      when signals were lost; none: outage, recovery_s and recovered are NaN
/// @param settle_s  the twin's errors before this time are not taken as ordinary ones [s]
DriveNumbers measureDrive(const DriveResult& result, const DriveErrors& twin, const SignalLoss& loss, double settle_s);

/// Moves the estimates so that the last one before `time_s` is the truth: dead reckoning from a known pose. Nothing is
/// left where the truth has no heading.
void layOntoTruthAt(double time_s, DriveResult& result);

/// The transform from estimate to truth that `config.align` asks for, as sidestep-localize takes it, applied to the
/// estimates. Where both frames are known nothing is moved.
void align(DriveResult& result, const LocalizeConfig& config);

}  // namespace sidestep
