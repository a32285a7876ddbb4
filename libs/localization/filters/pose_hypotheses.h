// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <vector>

#include "core/random.h"
#include "localization/filters/scan_model.h"
#include "localization/motion.h"

namespace sidestep {

/// Poses somewhere on the map, and how the scan fits there.
struct Candidates {
  Eigen::ArrayXd x, y, yaw, fit;  ///< [m, rad], log-likelihood of the whole scan
  double best = 0;                ///< largest fit

  /// `count` poses drawn evenly from all free space. Allocates.
  static Candidates draw(const ScanModel& model, const Scan& scan, size_t count, Random& random);
};

/// A few other places where the robot might be, each followed along and weighed by the same scans as the estimate.
///
/// What one scan says of a place is little: of thousands of places some fit it by chance, and things that the map does
/// not know make the right one fit badly for a while. A rival is chosen by one scan and judged by those that follow: a
/// cumulative sum test (Page 1954) of the log-likelihood ratio against the estimate, in which scans count by the way
/// between them, as views from the same spot err alike. Where the estimate is right, no place beats it for long,
/// however little the map explains; where it is wrong, the true place does.
class PoseHypotheses {
 public:
  static constexpr double kApart_m = 1;  ///< they are farther from the estimate

  explicit PoseHypotheses(size_t count) : most_(count) { hypotheses_.reserve(count); }
  void clear() { hypotheses_.clear(); }
  void move(const MotionStep& motion);
  /// Each rival goes to a better pose beside it if the scan shows one, then is compared with the estimate.
  /// @param fit     of the scan at the estimate, as ScanModel::judge gives it
  /// @param weight  what a nat of the scan's log-likelihood counts for
  void compare(const ScanModel& model, const Scan& scan, double fit, double weight, Random& random);
  /// The best of the candidates, apart from each other and from the estimate, in place of the worst rivals.
  void renew(const Candidates& from, const mrpt::math::TPose2D& estimate);
  /// Most evidence [nats, >= 0] for a rival farther than kApart_m from the estimate.
  double evidence(const mrpt::math::TPose2D& estimate) const;
  /// A pose about one of the rivals, chosen by exp(evidence).
  mrpt::math::TPose2D draw(Random& random) const;

  size_t size() const { return hypotheses_.size(); }
  void save(std::vector<double>& out) const;
  /// Reads what save wrote from its end on; gives where it began.
  const double* restore(const double* end);

 private:
  struct Hypothesis {
    mrpt::math::TPose2D pose;
    double evidence = 0;  ///< [nats]
  };
  size_t most_;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace sidestep
