// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "datasets/ground_truth.h"
#include "evaluation/metrics/trajectory_error.h"
#include "figures/trajectory_figure.h"
#include "localization/configuration.h"
#include "localization/localizer.h"

namespace sidestep {

/// Holds estimates until the truth of their time is known, and measures them against it.
class TruthComparison {
 public:
  /// Truth from `file`, or from the log (`push`) if that is empty.
  TruthComparison(const std::string& file, const LocalizeConfig& config);

  void push(double time_s, const mrpt::math::TPose2D& pose);
  void add(const Estimate& estimate);
  void finish();

  std::optional<TrajectoryErrors> estimateErrors(Alignment alignment) const;
  std::optional<TrajectoryErrors> odometryErrors() const;
  /// The truth's line, moved into the frame of the estimate.
  ThinnedLine truthLine(const TrajectoryErrors& errors) const;

 private:
  void settle(bool all);
  void compare(const Estimate& e, const StampedPose& truth);

  const LocalizeConfig& config_;
  std::unique_ptr<GroundTruth> truth_;
  bool from_file_;
  double newest_truth_s_ = -1e18;
  std::deque<Estimate> waiting_;
  TrajectoryErrorMeter estimate_, odometry_;
  ThinnedLine line_;
};

}  // namespace sidestep
