// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/experiments/drive.h"

namespace sidestep {

/// Names of what `driveMetrics` gives:
///   mean_error_m, mean_square_error_m2   ME and MSE of (3.18) over the drive
///   rmse_m, max_error_m, final_error_m, heading_mean_error_deg
///   mean_nees              of (x, y, yaw); 3 where the covariance tells the truth; 2 if the truth has no heading
///   nees                   the same by its degrees of freedom: 1 if consistent
///   nees_in_band           1 if this run's own 95 % band holds that (judgeNees), else 0; nothing after an alignment
///   nis_gps, nis_imu, nis_beacons   mean NIS by what a consistent filter has: 1
///   nis_gps_in_band, ...   1 if the 95 % band holds that, else 0
///   outage_error_m         mean error while signals are lost
///   outage_end_error_m     error when they come back
///   outage_added_m         by how much that is more than in the twin: the same run without the loss
///   recovery_s             from then until the error is an ordinary one again: at most the 95 % quantile of the twin's
///                          errors, or the twin's own at that time; until the end of the drive if it never is
///   recovered              1 if it ever is, else 0
/// Dead reckoning has no twin: of it the last three are NaN.
const std::vector<std::string>& driveMetricNames();

/// Errors of a drive, by time.
struct DriveErrors {
  std::vector<double> time_s, error_m;
};
DriveErrors errorsOf(const DriveResult& result);

/// @param twin      of the same run without a loss; used if there is one
/// @param loss      when signals were lost; none: the last five are NaN
/// @param settle_s  the twin's errors before this time are not taken as ordinary ones [s]
std::vector<double> driveMetrics(const DriveResult& result, const DriveErrors& twin, const SignalLoss& loss,
                                 double settle_s);

/// Moves the estimates so that the last one before `time_s` is the truth: dead reckoning from a known pose. Nothing is
/// left where the truth has no heading.
void layOntoTruthAt(double time_s, DriveResult& result);

/// The transform from estimate to truth that `config.align` asks for, as sidestep-localize takes it, applied to the
/// estimates. Where both frames are known nothing is moved.
void align(DriveResult& result, const LocalizeConfig& config);

}  // namespace sidestep
