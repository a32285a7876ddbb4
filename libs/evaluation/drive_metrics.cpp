// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/drive_metrics.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double errorOf(const PosePair& p) { return std::hypot(p.estimate.x - p.truth.x, p.estimate.y - p.truth.y); }

double neesOf(const PosePair& p) {
  const Eigen::Vector3d e(p.estimate.x - p.truth.x, p.estimate.y - p.truth.y,
                          mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi));
  const Eigen::LDLT<Eigen::Matrix3d> solver(p.covariance);
  // A covariance that knows one direction exactly (the first steps from an exact start) says nothing of the error in
  // it.
  const auto& d = solver.vectorD();
  if (solver.info() != Eigen::Success || !(d.minCoeff() > 1e-9 * d.maxCoeff())) return kNaN;
  return e.dot(solver.solve(e));
}

struct Mean {
  double sum = 0;
  size_t n = 0;
  void add(double v) {
    if (!std::isfinite(v)) return;
    sum += v;
    ++n;
  }
  double value() const { return n > 0 ? sum / static_cast<double>(n) : kNaN; }
};

struct LossMetrics {
  double mean = kNaN, at_end = kNaN, added = kNaN, recovery_s = kNaN;
};

/// The 95 % quantile of the errors from settle_s on.
double ordinaryError(const std::vector<PosePair>& pairs, double settle_s) {
  std::vector<double> errors;
  for (const auto& p : pairs)
    if (p.time_s >= settle_s) errors.push_back(errorOf(p));
  if (errors.empty()) return kNaN;
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

/// Errors of a twin, by time.
class ErrorAt {
 public:
  explicit ErrorAt(const std::vector<PosePair>& pairs) : pairs_(pairs) {}
  /// Of the last pair up to that time; times must not decrease. NaN before the first.
  double operator()(double time_s) {
    while (next_ < pairs_.size() && pairs_[next_].time_s <= time_s) ++next_;
    return next_ > 0 ? errorOf(pairs_[next_ - 1]) : kNaN;
  }

 private:
  const std::vector<PosePair>& pairs_;
  size_t next_ = 0;
};

LossMetrics lossMetrics(const std::vector<PosePair>& pairs, const std::vector<PosePair>& twin, const SignalLoss& loss,
                        double settle_s) {
  LossMetrics m;
  if (!loss.any() || pairs.empty()) return m;
  const double ordinary = ordinaryError(twin, settle_s);
  ErrorAt twin_error(twin);
  Mean mean;
  bool recovered = false, first = true;
  for (const auto& p : pairs) {
    const double error = errorOf(p), without = twin_error(p.time_s);
    if (loss.covers(p.time_s)) {
      mean.add(error);
      m.at_end = error;
      m.added = error - without;
    }
    if (p.time_s < loss.to_s || recovered) continue;
    m.recovery_s = p.time_s - loss.to_s;
    recovered = error <= std::max(ordinary, without);
    if (first && recovered) m.recovery_s = 0;
    first = false;
  }
  m.mean = mean.value();
  return m;
}

}  // namespace

const std::vector<std::string>& driveMetricNames() {
  static const std::vector<std::string> names = {
      "mean_error_m",       "mean_square_error_m2",   "rmse_m",    "max_error_m",
      "final_error_m",      "heading_mean_error_deg", "mean_nees", "outage_error_m",
      "outage_end_error_m", "outage_added_m",         "recovery_s"};
  return names;
}

std::vector<double> driveMetrics(const DriveResult& result, const DriveResult& twin, const SignalLoss& loss,
                                 double settle_s) {
  Mean error, square, heading, nees;
  double largest = kNaN;
  for (const auto& p : result.pairs) {
    const double e = errorOf(p);
    error.add(e);
    square.add(e * e);
    if (!(largest >= e)) largest = e;
    if (p.has_heading) heading.add(std::abs(mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi)) * 180 / M_PI);
    if (p.has_heading) nees.add(neesOf(p));
  }
  double spread = 0;  // of the error about its mean
  for (const auto& p : result.pairs) spread += std::pow(errorOf(p) - error.value(), 2);
  const double n = static_cast<double>(result.pairs.size());
  const LossMetrics lost = lossMetrics(result.pairs, twin.pairs, loss, settle_s);
  return {error.value(),
          n > 0 ? spread / n : kNaN,
          std::sqrt(square.value()),
          largest,
          n > 0 ? errorOf(result.pairs.back()) : kNaN,
          heading.value(),
          nees.value(),
          lost.mean,
          lost.at_end,
          lost.added,
          lost.recovery_s};
}

void align(DriveResult& result, const LocalizeConfig& config) {
  Alignment how = Alignment::kNone;
  if (config.align == "first") how = Alignment::kFirstPose;
  if (config.align == "se2") how = Alignment::kLeastSquares;
  if (config.align == "auto") {
    const bool beacons = config.uses("beacons");
    const bool known = (result.gave_fixes && config.robot.gps.datum_given) || (beacons && config.truth_frame_given);
    if (!known) how = result.gave_fixes || beacons ? Alignment::kLeastSquares : Alignment::kFirstPose;
  }
  if (how == Alignment::kNone || result.pairs.empty()) return;
  TrajectoryErrorMeter meter;
  for (const auto& p : result.pairs) meter.add(p);
  const auto T = meter.measure(how).T_truth_estimate;
  const double c = std::cos(T.phi), s = std::sin(T.phi);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << c, -s, s, c;
  const auto moved = [&](const mrpt::math::TPose2D& e) -> mrpt::math::TPose2D {
    return {T.x + c * e.x - s * e.y, T.y + s * e.x + c * e.y, mrpt::math::wrapToPi(T.phi + e.phi)};
  };
  for (auto& p : result.pairs) {
    p.estimate = moved(p.estimate);
    p.covariance = turn * p.covariance * turn.transpose();
  }
  for (auto& o : result.odometry) o = moved(o);
  for (auto& f : result.fixes) f = {T.x + c * f.x - s * f.y, T.y + s * f.x + c * f.y};
}

}  // namespace sidestep
