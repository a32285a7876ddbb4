// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/random.h"
#include "localization/motion.h"
#include "localization/scan_model.h"

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
/// What one scan says of a place is little: of thousands of places some fit it by chance. A rival is chosen by one scan
/// and judged by those that follow, by the mean of (log-likelihood at the rival) - (log-likelihood at the estimate).
/// Where the estimate is right, no place beats it for long, however little the map explains; where it is wrong, the
/// true place does. All rivals are farther from the estimate than `kApart_m` when chosen.
class Rivals {
 public:
  static constexpr double kApart_m = 1;

  explicit Rivals(size_t count) : most_(count) { rivals_.reserve(count); }
  void clear() { rivals_.clear(); }
  void move(const MotionStep& motion);
  /// Each rival steps to a better pose beside it if the scan shows one, then is compared with the estimate.
  /// @param fit  log-likelihood of the scan at the estimate
  void compare(const ScanModel& model, const Scan& scan, double fit, Random& random);
  /// The best of the candidates, apart from each other and from the estimate, in place of the worst rivals.
  void renew(const Candidates& from, const mrpt::math::TPose2D& estimate);
  /// Largest mean advantage over the estimate of a rival farther than kApart_m from it; none before two scans.
  std::optional<double> advantage(const mrpt::math::TPose2D& estimate) const;

  size_t size() const { return rivals_.size(); }
  void save(std::vector<double>& out) const;
  /// Reads what save wrote from its end on; gives where it began.
  const double* restore(const double* end);

 private:
  struct Rival {
    mrpt::math::TPose2D pose;
    double advantage = 0, scans = 0;
  };
  size_t most_;
  std::vector<Rival> rivals_;
};

}  // namespace sidestep
