// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/trajectory_error.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/errors.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A pair as it lies in the temporary file.
struct Record {
  double time_s, estimate[3], truth[3], covariance[6], has_heading;
};
static_assert(std::is_trivially_copyable_v<Record>);

Record toRecord(const PosePair& pair) {
  const auto& e = pair.estimate;
  const auto& t = pair.truth;
  const auto& c = pair.covariance;
  return {pair.time_s,
          {e.x, e.y, e.phi},
          {t.x, t.y, t.phi},
          {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)},
          pair.has_heading ? 1.0 : 0.0};
}

PosePair toPair(const Record& record) {
  PosePair pair;
  pair.time_s = record.time_s;
  pair.estimate = TPose2D(record.estimate[0], record.estimate[1], record.estimate[2]);
  pair.truth = TPose2D(record.truth[0], record.truth[1], record.truth[2]);
  const double* c = record.covariance;
  pair.covariance << c[0], c[1], c[2], c[1], c[3], c[4], c[2], c[4], c[5];
  pair.has_heading = record.has_heading > 0.5;
  return pair;
}

[[noreturn]] void throwFileError(const char* what) {
  throw Error(ExitCode::kInternalError, std::string("temporary file of the trajectory's poses: cannot ") + what + ": " +
                                            std::strerror(errno) + "; is the disk full?");
}

/// Running mean and central second moment (Welford 1962).
class Moments {
 public:
  void add(double value) {
    ++count_;
    const double delta = value - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (value - mean_);
  }
  uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  double variance() const { return count_ == 0 ? 0 : squares_ / static_cast<double>(count_); }

 private:
  uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// Centroids and cross moments of two point sets; the rigid transform between them follows in closed form.
class RigidFit {
 public:
  void add(const TPose2D& from, const TPose2D& to) {
    ++count_;
    const double n = static_cast<double>(count_);
    const Eigen::Vector2d p(from.x, from.y), q(to.x, to.y);
    const Eigen::Vector2d dp = p - p_mean_;
    p_mean_ += dp / n;
    q_mean_ += (q - q_mean_) / n;
    const Eigen::Vector2d dq = q - q_mean_;
    dot_ += dp.dot(dq);
    cross_ += dp.x() * dq.y() - dp.y() * dq.x();
  }
  /// A millimetre of common motion is the least that tells a rotation.
  bool isDegenerate() const { return !(std::hypot(dot_, cross_) > 1e-6 * static_cast<double>(count_)); }
  /// argmin over (R, t) of sum |R p + t - q|^2: angle atan2(sum dp x dq, sum dp . dq), then the centroids meet.
  TPose2D transform() const {
    const double angle = std::atan2(cross_, dot_);
    const Eigen::Vector2d t = q_mean_ - Eigen::Rotation2Dd(angle) * p_mean_;
    return {t.x(), t.y(), angle};
  }

 private:
  uint64_t count_ = 0;
  Eigen::Vector2d p_mean_ = Eigen::Vector2d::Zero(), q_mean_ = Eigen::Vector2d::Zero();
  double dot_ = 0, cross_ = 0;
};

/// A covariance of (x, y, yaw) in a frame turned by `turn`.
Eigen::Matrix3d turned(const Eigen::Matrix3d& covariance, double turn) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(turn).toRotationMatrix();
  return R * covariance * R.transpose();
}

/// The second pass: errors of aligned pairs.
class ErrorSums {
 public:
  explicit ErrorSums(const TPose2D& T_truth_estimate) : T_(T_truth_estimate) {}

  void add(const PosePair& pair) {
    const TPose2D aligned = T_ + pair.estimate;
    const Eigen::Vector2d e(aligned.x - pair.truth.x, aligned.y - pair.truth.y);
    const double distance = e.norm();
    distance_.add(distance);
    square_.add(distance * distance);
    max_ = std::max(max_, distance);
    final_ = distance;
    const double heading = pair.has_heading ? mrpt::math::wrapToPi(aligned.phi - pair.truth.phi) : 0;
    if (pair.has_heading) heading_.add(std::abs(heading));
    nees_.add(pair.time_s, {e.x(), e.y(), heading}, turned(pair.covariance, T_.phi), pair.has_heading);
  }

  TrajectoryErrors result() const {
    TrajectoryErrors errors;
    errors.samples = distance_.count();
    errors.mean_error_m = distance_.mean();
    errors.mean_square_error_m2 = distance_.variance();
    errors.rmse_m = std::sqrt(square_.mean());
    errors.max_error_m = max_;
    errors.final_error_m = final_;
    errors.heading_mean_error_deg = heading_.mean() * 180 / std::numbers::pi;
    errors.heading_samples = heading_.count();
    errors.mean_nees = nees_.meanNees();
    errors.nees = nees_;
    return errors;
  }

 private:
  TPose2D T_;
  Moments distance_, square_, heading_;
  NormalizedErrors nees_{2000};
  double max_ = 0, final_ = 0;
};

struct Applied {
  Alignment alignment = Alignment::kNone;
  TPose2D T;
};

TPose2D firstPoseTransform(const PosePair& first) {
  if (first.has_heading) return first.truth + (TPose2D() - first.estimate);
  return {first.truth.x - first.estimate.x, first.truth.y - first.estimate.y, 0};
}

}  // namespace

const Metrics<TrajectoryErrors>& errorMetrics() {
  using E = TrajectoryErrors;
  static const Metrics<E> rows = {
      {{"mean_error_m", "m", "mean distance from the truth, ME of (3.18)", Better::kLower, "mean error [m]"},
       [](const E& e) { return e.mean_error_m; }},
      {{"mean_square_error_m2", "m2", "variance of that distance about its mean, MSE of (3.18)", Better::kLower, ""},
       [](const E& e) { return e.mean_square_error_m2; }},
      {{"rmse_m", "m", "root of the mean square distance", Better::kLower, "rmse [m]"},
       [](const E& e) { return e.rmse_m; }},
      {{"max_error_m", "m", "largest distance", Better::kLower, "max [m]"}, [](const E& e) { return e.max_error_m; }},
      {{"final_error_m", "m", "distance at the end", Better::kLower, "final [m]"},
       [](const E& e) { return e.final_error_m; }},
      {{"heading_mean_error_deg", "deg", "mean size of the heading's error", Better::kLower, "heading [deg]"},
       [](const E& e) { return e.heading_samples > 0 ? e.heading_mean_error_deg : kNaN; }}};
  return rows;
}

const Metrics<TrajectoryErrors>& neesMetrics() {
  static const Metrics<TrajectoryErrors> rows = {
      {{"mean_nees", "1", "mean squared error by the covariance; 3 if consistent, 2 without a true heading",
        Better::kTarget, "NEES"},
       [](const TrajectoryErrors& e) { return e.mean_nees.value_or(kNaN); }}};
  return rows;
}

struct TrajectoryErrorMeter::Impl {
  std::FILE* file = nullptr;
  uint64_t count = 0;

  Impl() : file(std::tmpfile()) {
    if (!file) throwFileError("create");
  }
  ~Impl() { std::fclose(file); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  template <class Visit>
  void forEach(Visit visit) const {
    if (std::fseek(file, 0, SEEK_SET) != 0) throwFileError("rewind");
    for (uint64_t i = 0; i < count; ++i) {
      Record record;
      if (std::fread(&record, sizeof record, 1, file) != 1) throwFileError("read");
      visit(toPair(record));
    }
    if (std::fseek(file, 0, SEEK_END) != 0) throwFileError("wind");
  }

  Applied align(Alignment wish) const {
    if (wish == Alignment::kNone || count == 0) return {wish, {}};
    PosePair first;
    RigidFit fit;
    uint64_t seen = 0;
    forEach([&](const PosePair& pair) {
      if (seen++ == 0) first = pair;
      fit.add(pair.estimate, pair.truth);
    });
    const bool squares = wish == Alignment::kLeastSquares || !first.has_heading;
    if (squares && !fit.isDegenerate()) return {Alignment::kLeastSquares, fit.transform()};
    return {Alignment::kFirstPose, firstPoseTransform(first)};
  }
};

TrajectoryErrorMeter::TrajectoryErrorMeter() : impl_(std::make_unique<Impl>()) {}
TrajectoryErrorMeter::~TrajectoryErrorMeter() = default;

void TrajectoryErrorMeter::add(const PosePair& pair) {
  const Record record = toRecord(pair);
  if (std::fwrite(&record, sizeof record, 1, impl_->file) != 1) throwFileError("write");
  ++impl_->count;
}

uint64_t TrajectoryErrorMeter::samples() const { return impl_->count; }

TrajectoryErrors TrajectoryErrorMeter::measure(Alignment alignment) const {
  const Applied applied = impl_->align(alignment);
  ErrorSums sums(applied.T);
  impl_->forEach([&](const PosePair& pair) { sums.add(pair); });
  TrajectoryErrors errors = sums.result();
  errors.alignment = applied.alignment;
  if (applied.alignment == Alignment::kNone && errors.mean_nees)
    errors.consistency = judgeNees(*errors.mean_nees, errors.nees.effectiveCount(), errors.nees.dof());
  errors.T_truth_estimate = applied.T;
  return errors;
}

}  // namespace sidestep
