// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "evaluation/drive.h"

namespace sidestep {

/// Names of what `driveMetrics` gives:
///   mean_error_m, mean_square_error_m2   ME and MSE of (3.18) over the drive
///   rmse_m, max_error_m, final_error_m, heading_mean_error_deg
///   mean_nees              of (x, y, yaw); 3 where the covariance tells the truth
///   outage_error_m         mean error while signals are lost
///   outage_end_error_m     error when they come back
///   outage_added_m         by how much that is more than in the twin: the same run without the loss
///   recovery_s             from then until the error is an ordinary one again: at most the 95 % quantile of the twin's
///                          errors, or the twin's own at that time; until the end of the drive if it never is
const std::vector<std::string>& driveMetricNames();

/// @param twin      the same run without a loss; used if there is one
/// @param loss      when signals were lost; none: the last four are NaN
/// @param settle_s  the twin's errors before this time are not taken as ordinary ones [s]
std::vector<double> driveMetrics(const DriveResult& result, const DriveResult& twin, const SignalLoss& loss,
                                 double settle_s);

/// The transform from estimate to truth that `config.align` asks for, as sidestep-localize takes it, applied to the
/// estimates. Where both frames are known nothing is moved.
void align(DriveResult& result, const LocalizeConfig& config);

}  // namespace sidestep
