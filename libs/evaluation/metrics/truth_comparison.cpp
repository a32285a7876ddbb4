// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/truth_comparison.h"

#include <mrpt/poses/CPose2D.h>

namespace sidestep {

TruthComparison::TruthComparison(const std::string& file, const LocalizeConfig& config)
    : config_(config),
      truth_(file.empty() ? std::make_unique<GroundTruth>() : GroundTruth::fromFile(file)),
      from_file_(!file.empty()) {}

void TruthComparison::push(double time_s, const mrpt::math::TPose2D& pose) {
  if (from_file_) return;
  if (truth_->push({time_s, pose, true})) newest_truth_s_ = time_s;
}

void TruthComparison::add(const Estimate& estimate) {
  waiting_.push_back(estimate);
  settle(false);
}

void TruthComparison::finish() { settle(true); }

void TruthComparison::settle(bool all) {
  constexpr size_t kMostWaiting = 20000;  // a log whose truth has ended must not fill the memory
  while (!waiting_.empty()) {
    const Estimate& e = waiting_.front();
    const bool known = all || from_file_ || e.time_s <= newest_truth_s_ || waiting_.size() > kMostWaiting;
    if (!known) return;
    std::optional<StampedPose> truth;
    if (!truth_->isRowIndexed())
      truth = truth_->at(e.time_s);
    else if (e.odometry_index)
      truth = truth_->row(*e.odometry_index);
    if (truth) compare(e, *truth);
    waiting_.pop_front();
  }
}

void TruthComparison::compare(const Estimate& e, const StampedPose& truth) {
  PosePair pair;
  pair.time_s = e.time_s;
  pair.truth = config_.truthInMap(truth.pose);
  pair.has_heading = truth.has_heading;
  pair.estimate = e.belief.mean;
  pair.covariance = e.belief.covariance;
  estimate_.add(pair);
  pair.estimate = e.odometry;
  pair.covariance.setZero();
  odometry_.add(pair);
  line_.add(pair.truth.x, pair.truth.y);
}

std::optional<TrajectoryErrors> TruthComparison::estimateErrors(Alignment alignment) const {
  if (estimate_.samples() == 0) return std::nullopt;
  return estimate_.measure(alignment);
}

std::optional<TrajectoryErrors> TruthComparison::odometryErrors() const {
  if (odometry_.samples() == 0) return std::nullopt;
  return odometry_.measure(Alignment::kFirstPose);
}

ThinnedLine TruthComparison::truthLine(const TrajectoryErrors& errors) const {
  const mrpt::poses::CPose2D T_truth_map(errors.T_truth_estimate);
  ThinnedLine out;
  for (const auto& p : line_.points()) {
    const auto q = T_truth_map.inverseComposePoint(mrpt::math::TPoint2D(p.x, p.y));
    out.add(q.x, q.y);
  }
  return out;
}

}  // namespace sidestep
