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

void measureLoss(const std::vector<PosePair>& pairs, const DriveErrors& twin, const SignalLoss& loss, double settle_s,
                 DriveNumbers& out) {
  if (!loss.any() || pairs.empty()) return;
  const double ordinary = ordinaryError(twin, settle_s);
  ErrorAt twin_error(twin);
  Mean mean;
  const bool has_twin = !twin.time_s.empty();
  bool recovered = false, first = true;
  for (const auto& p : pairs) {
    const double error = errorOf(p), without = twin_error(p.time_s);
    if (loss.covers(p.time_s)) {
      mean.add(error);
      out.outage_end_error_m = error;
      out.outage_added_m = error - without;
    }
    if (p.time_s < loss.to_s || recovered || !has_twin) continue;
    out.recovery_s = p.time_s - loss.to_s;
    recovered = error <= std::max(ordinary, without);
    if (first && recovered) out.recovery_s = 0;
    first = false;
  }
  out.outage_error_m = mean.value();
  if (!first) out.recovered = recovered ? 1 : 0;
}

void measureNees(const DriveResult& result, DriveNumbers& out) {
  NormalizedErrors errors;
  for (const auto& p : result.pairs)
    errors.add(p.time_s,
               {p.estimate.x - p.truth.x, p.estimate.y - p.truth.y,
                p.has_heading ? mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi) : 0},
               p.covariance, p.has_heading);
  out.errors.mean_nees = errors.meanNees();
  const double mean = errors.meanNees().value_or(kNaN);
  out.nees.mean = mean / errors.dof();
  if (errors.count() > 0 && !result.aligned)
    out.nees.in_band = judgeNees(mean, errors.effectiveCount(), errors.dof()).verdict == "consistent";
}

void measureNis(const DriveResult& result, DriveNumbers& out) {
  if (!result.gate_probability) return;
  for (const auto& k : result.nis) {
    const double mean = k.sum / k.count;
    const Consistency c = judgeSensor(mean, k.count, k.independent, k.dof, *result.gate_probability);
    out.nis.insert({k.kind, {mean / c.band.expected, c.verdict == "consistent" ? 1.0 : 0.0}});
  }
}

void measureErrors(const std::vector<PosePair>& pairs, TrajectoryErrors& out) {
  Mean error, square, heading;
  out.max_error_m = kNaN;
  for (const auto& p : pairs) {
    const double e = errorOf(p);
    error.add(e);
    square.add(e * e);
    if (!(out.max_error_m >= e)) out.max_error_m = e;
    if (p.has_heading) heading.add(std::abs(mrpt::math::wrapToPi(p.estimate.phi - p.truth.phi)) * 180 / M_PI);
  }
  double spread = 0;  // of the error about its mean
  for (const auto& p : pairs) spread += std::pow(errorOf(p) - error.value(), 2);
  out.samples = pairs.size();
  out.mean_error_m = error.value();
  out.mean_square_error_m2 = pairs.empty() ? kNaN : spread / static_cast<double>(pairs.size());
  out.rmse_m = std::sqrt(square.value());
  out.final_error_m = pairs.empty() ? kNaN : errorOf(pairs.back());
  out.heading_mean_error_deg = heading.value();
  out.heading_samples = heading.n;
}

/// NAME and NAME_in_band, for the verdict over all runs (study_consistency.h).
void addRatio(const std::string& name, const std::string& meaning,
              const std::function<DriveNumbers::Ratio(const DriveNumbers&)>& of, Metrics<DriveNumbers>& rows) {
  rows.push_back({{name, "1", meaning + ", by what a consistent filter has: 1", Better::kTarget, ""},
                  [of](const DriveNumbers& d) { return of(d).mean; }});
  rows.push_back({{name + "_in_band", "yes/no", "whether the run's own 95 % interval holds that", Better::kHigher, ""},
                  [of](const DriveNumbers& d) { return of(d).in_band; }});
}

}  // namespace

const Metrics<DriveNumbers>& driveMetrics() {
  using D = DriveNumbers;
  static const Metrics<D> rows = [] {
    Metrics<D> out = ofPart(errorMetrics(), &D::errors);
    for (const auto& row : ofPart(neesMetrics(), &D::errors)) out.push_back(row);
    addRatio(
        "nees", "mean NEES", [](const D& d) { return d.nees; }, out);
    for (const std::string kind : {"gps", "imu", "beacons"})
      addRatio(
          "nis_" + kind, "mean NIS of " + kind,
          [kind](const D& d) {
            const auto it = d.nis.find(kind);
            return it == d.nis.end() ? D::Ratio{} : it->second;
          },
          out);
    const Metrics<D> outage = {
        {{"outage_error_m", "m", "mean error while signals are lost", Better::kLower, ""},
         [](const D& d) { return d.outage_error_m; }},
        {{"outage_end_error_m", "m", "error when signals come back", Better::kLower, ""},
         [](const D& d) { return d.outage_end_error_m; }},
        {{"outage_added_m", "m", "by how much that is more than in the same run without the loss", Better::kLower, ""},
         [](const D& d) { return d.outage_added_m; }},
        {{"recovery_s", "s",
          "from then until the error is at most the 95 % quantile of the run without the loss, or its error at that "
          "time; until the end if it never is",
          Better::kLower, ""},
         [](const D& d) { return d.recovery_s; }},
        {{"recovered", "yes/no", "whether it ever is", Better::kHigher, ""}, [](const D& d) { return d.recovered; }}};
    out.insert(out.end(), outage.begin(), outage.end());
    return out;
  }();
  return rows;
}

DriveErrors errorsOf(const DriveResult& result) {
  DriveErrors out;
  for (const auto& p : result.pairs) {
    out.time_s.push_back(p.time_s);
    out.error_m.push_back(errorOf(p));
  }
  return out;
}

DriveNumbers measureDrive(const DriveResult& result, const DriveErrors& twin, const SignalLoss& loss, double settle_s) {
  DriveNumbers out;
  measureErrors(result.pairs, out.errors);
  measureNees(result, out);
  measureNis(result, out);
  measureLoss(result.pairs, twin, loss, settle_s, out);
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
