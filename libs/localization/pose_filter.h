// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "localization/measurement.h"
#include "localization/motion.h"

namespace sidestep {

/// What became of a measurement.
struct Correction {
  enum class Reason { kAccepted, kReset, kGated, kNotFinite, kTooLate, kNotObservable, kNothingNew };
  Reason reason = Reason::kAccepted;
  double nis = 0;         ///< normalized innovation squared, against the covariance before the correction
  int dof = 0;            ///< its degrees of freedom
  double nis_single = 0;  ///< NIS with the variance of this measurement by itself (Measurement::covariance_inflation)
  bool accepted() const { return reason == Reason::kAccepted || reason == Reason::kReset; }
};

/// The word of a reason, as metrics.json spells it: "outside_gate", "too_late", ...
const char* word(Correction::Reason reason);

/// A belief as every filter gives it: mean and covariance of (x, y, yaw).
struct PoseBelief {
  mrpt::math::TPose2D mean;  ///< map frame [m, rad], yaw in (-pi, pi]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// One of several places where the robot may be.
struct PoseMode {
  double weight = 0;  ///< probability that it is here
  PoseBelief belief;
};

/// A recursive estimator of the robot's pose in the plane.
///
/// Given `start`, then in time order `predict` for each stretch of motion and `correct` for each measurement that falls
/// between two stretches. `estimate` is finite after any sequence of calls; whatever is not finite is refused. A filter
/// never reads a clock or a file. `save` and `restore` carry the whole state, so that a measurement that comes late can
/// be put where it belongs and what followed be played again.
class PoseFilter {
 public:
  virtual ~PoseFilter() = default;
  virtual void start(const PoseBelief& belief) = 0;
  virtual void predict(const MotionStep& motion) = 0;
  virtual Correction correct(const Measurement& measurement) = 0;
  virtual PoseBelief estimate() const = 0;
  /// Probability that the estimate is off by more than 1 m, of filters that can tell.
  virtual std::optional<double> lostProbability() const { return std::nullopt; }
  /// The places where the robot may be, heaviest first, of filters that can hold several; else nothing.
  virtual std::vector<PoseMode> modes() const { return {}; }
  /// State into `out`, which keeps its memory between calls.
  virtual void save(std::vector<double>& out) const = 0;
  virtual void restore(const std::vector<double>& state) = 0;

  /// One step back of the Rauch-Tung-Striebel smoother: `before` and `after` are what `save` gave around
  /// `predict(motion)`, `smoothed` the state at its end given the whole log, which becomes the state at its beginning.
  /// @return false if this filter has no such step, or its numbers are not finite.
  virtual bool smoothBack(const std::vector<double>& before, const MotionStep& motion, const std::vector<double>& after,
                          std::vector<double>& smoothed) const;
  /// The same where a correction opened the covariance `opened` times (Correction::Reason::kReset); `before` is the
  /// state before that.
  virtual void smoothReset(const std::vector<double>& before, double opened, std::vector<double>& smoothed) const;
};

}  // namespace sidestep
