// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/drive_metrics.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/metrics/alignment.h"
#include "evaluation/metrics/consistency.h"
#include "evaluation/metrics/normalized_errors.h"

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double errorOf(const PosePair& p) { return std::hypot(p.estimate.x - p.truth.x, p.estimate.y - p.truth.y); }

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
  double mean = kNaN, at_end = kNaN, added = kNaN, recovery_s = kNaN, recovered = kNaN;
};

/// The 95 % quantile of the errors from settle_s on.
double ordinaryError(const DriveErrors& drive, double settle_s) {
  std::vector<double> errors;
  for (size_t i = 0; i < drive.time_s.size(); ++i)
    if (drive.time_s[i] >= settle_s) errors.push_back(drive.error_m[i]);
  if (errors.empty()) return kNaN;
  const auto at = errors.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

/// Errors of a twin, by time.
class ErrorAt {
 public:
  explicit ErrorAt(const DriveErrors& drive) : drive_(drive) {}
  /// Of the last pair up to that time; times must not decrease. NaN before the first.
  double operator()(double time_s) {
    while (next_ < drive_.time_s.size() && drive_.time_s[next_] <= time_s) ++next_;
    return next_ > 0 ? drive_.error_m[next_ - 1] : kNaN;
  }

 private:
  const DriveErrors& drive_;
  size_t next_ = 0;
};

LossMetrics lossMetrics(const std::vector<PosePair>& pairs, const DriveErrors& twin, const SignalLoss& loss,
                        double settle_s) {
  LossMetrics m;
  if (!loss.any() || pairs.empty()) return m;
  const double ordinary = ordinaryError(twin, settle_s);
  ErrorAt twin_error(twin);
  Mean mean;
  const bool has_twin = !twin.time_s.empty();
  bool recovered = false, first = true;
  for (const auto& p : pairs) {
    const double error = errorOf(p), without = twin_error(p.time_s);
    if (loss.covers(p.time_s)) {
      mean.add(error);
      m.at_end = error;
      m.added = error - without;
    }
    if (p.time_s < loss.to_s || recovered || !has_twin) continue;
    m.recovery_s = p.time_s - loss.to_s;
    recovered = error <= std::max(ordinary, without);
    if (first && recovered) m.recovery_s = 0;
    first = false;
  }
  m.mean = mean.value();
  if (!first) m.recovered = recovered ? 1 : 0;
  return m;
}

/// nees, nees_in_band.
void addNees(const DriveResult& result, std::vector<double>& out) {
  NormalizedErrors errors;
  for (const auto& p : result.pairs)
    errors.add(p.time_s,
               {p.estimate.x - p.truth.x, p.estimate.y - p.truth.y,
                p.has_heading ? mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi) : 0},
               p.covariance, p.has_heading);
  const double mean = errors.meanNees().value_or(kNaN);
  out.insert(out.end(), {mean, mean / errors.dof()});
  const bool judged = errors.count() > 0 && !result.aligned;
  out.push_back(judged ? judgeNees(mean, errors.effectiveCount(), errors.dof()).verdict == "consistent" : kNaN);
}

/// nis_KIND, nis_KIND_in_band.
void addNis(const DriveResult& result, const std::string& kind, std::vector<double>& out) {
  const auto it = std::find_if(result.nis.begin(), result.nis.end(), [&](const auto& k) { return k.kind == kind; });
  if (it == result.nis.end() || !result.gate_probability) return out.resize(out.size() + 2, kNaN);
  const double mean = it->sum / it->count;
  const Consistency c = judgeSensor(mean, it->count, it->independent, it->dof, *result.gate_probability);
  out.insert(out.end(), {mean / c.band.expected, c.verdict == "consistent" ? 1.0 : 0.0});
}

}  // namespace

const std::vector<std::string>& driveMetricNames() {
  static const std::vector<std::string> names = {"mean_error_m",
                                                 "mean_square_error_m2",
                                                 "rmse_m",
                                                 "max_error_m",
                                                 "final_error_m",
                                                 "heading_mean_error_deg",
                                                 "mean_nees",
                                                 "nees",
                                                 "nees_in_band",
                                                 "nis_gps",
                                                 "nis_gps_in_band",
                                                 "nis_imu",
                                                 "nis_imu_in_band",
                                                 "nis_beacons",
                                                 "nis_beacons_in_band",
                                                 "outage_error_m",
                                                 "outage_end_error_m",
                                                 "outage_added_m",
                                                 "recovery_s",
                                                 "recovered"};
  return names;
}

DriveErrors errorsOf(const DriveResult& result) {
  DriveErrors out;
  for (const auto& p : result.pairs) {
    out.time_s.push_back(p.time_s);
    out.error_m.push_back(errorOf(p));
  }
  return out;
}

std::vector<double> driveMetrics(const DriveResult& result, const DriveErrors& twin, const SignalLoss& loss,
                                 double settle_s) {
  Mean error, square, heading;
  double largest = kNaN;
  for (const auto& p : result.pairs) {
    const double e = errorOf(p);
    error.add(e);
    square.add(e * e);
    if (!(largest >= e)) largest = e;
    if (p.has_heading) heading.add(std::abs(mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi)) * 180 / M_PI);
  }
  double spread = 0;  // of the error about its mean
  for (const auto& p : result.pairs) spread += std::pow(errorOf(p) - error.value(), 2);
  const double n = static_cast<double>(result.pairs.size());
  std::vector<double> out = {error.value(),
                             n > 0 ? spread / n : kNaN,
                             std::sqrt(square.value()),
                             largest,
                             n > 0 ? errorOf(result.pairs.back()) : kNaN,
                             heading.value()};
  addNees(result, out);
  for (const char* kind : {"gps", "imu", "beacons"}) addNis(result, kind, out);
  const LossMetrics lost = lossMetrics(result.pairs, twin, loss, settle_s);
  out.insert(out.end(), {lost.mean, lost.at_end, lost.added, lost.recovery_s, lost.recovered});
  return out;
}

void layOntoTruthAt(double time_s, DriveResult& result) {
  const PosePair* at = nullptr;
  for (const auto& p : result.pairs)
    if (p.time_s < time_s || at == nullptr) at = &p;
  if (at == nullptr || !at->has_heading) return result.pairs.clear();
  const mrpt::math::TPose2D T = at->truth + (mrpt::math::TPose2D() - at->estimate);
  for (auto& p : result.pairs) p.estimate = T + p.estimate;
  result.aligned = true;
}

void align(DriveResult& result, const LocalizeConfig& config) {
  const Alignment how = alignmentFor(config, result.sensors);
  if (how == Alignment::kNone || result.pairs.empty()) return;
  result.aligned = true;
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
