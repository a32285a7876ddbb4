// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "evaluation/metrics/consistency.h"
#include "evaluation/metrics/metric.h"
#include "evaluation/metrics/normalized_errors.h"

namespace sidestep {

/// One instant at which estimate and truth are both known.
struct PosePair {
  double time_s = 0;
  mrpt::math::TPose2D estimate;                          ///< [m, rad], estimate's frame
  mrpt::math::TPose2D truth;                             ///< [m, rad], truth's frame
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the estimate (x, y, yaw); zero = unknown
  bool has_heading = true;  ///< of the truth; without it the pair counts for positions only
};

/// How the estimate's frame is laid onto the truth's before errors are taken: not at all; by the transform that maps
/// the first estimate onto the first truth, heading included; by the rigid transform that is best in the least squares
/// of the positions. The last needs a robot that moved (else the first pose is used), the second a first truth with
/// heading (else least squares); TrajectoryErrors::alignment says which one was applied.
enum class Alignment { kNone, kFirstPose, kLeastSquares };

/// Errors of a trajectory against truth.
struct TrajectoryErrors {
  uint64_t samples = 0;
  double mean_error_m = 0;  ///< ME of (3.18)
  double mean_square_error_m2 =
      0;  ///< MSE of (3.18): variance (over n) of the error about its mean, not the mean of e^2
  double rmse_m = 0;
  double max_error_m = 0;
  double final_error_m = 0;
  double heading_mean_error_deg = 0;  ///< mean of |wrapped heading error|
  uint64_t heading_samples = 0;       ///< pairs whose truth has a heading; 0 = heading_mean_error_deg says nothing
  std::optional<double> mean_nees;    ///< 3 (without heading 2) if consistent; only where covariances are known
  NormalizedErrors nees;
  std::optional<Consistency> consistency;  ///< of the NEES; nothing after an alignment, which takes errors away
  Alignment alignment = Alignment::kNone;
  mrpt::math::TPose2D T_truth_estimate;  ///< the alignment that was applied
};

/// Errors in metres and degrees, and the mean NEES. What is not known is NaN.
const Metrics<TrajectoryErrors>& errorMetrics();
const Metrics<TrajectoryErrors>& neesMetrics();

/// Collects pairs and measures them; pairs are kept in an unlinked temporary file, so memory does not grow with them.
class TrajectoryErrorMeter {
 public:
  TrajectoryErrorMeter();
  ~TrajectoryErrorMeter();
  /// @throws Error (internal) if the temporary file is full.
  void add(const PosePair& pair);
  uint64_t samples() const;
  /// Two passes over the pairs. With no samples all errors are zero and `samples` is 0.
  TrajectoryErrors measure(Alignment alignment) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sidestep
