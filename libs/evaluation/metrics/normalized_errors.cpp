// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/normalized_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace sidestep {
namespace {

/// L^-1 e with P = L L' in the first `dof` components; nothing where P says nothing of some direction.
std::optional<Eigen::Vector3d> normalized(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance, int dof) {
  const Eigen::Matrix3d P = [&] {
    Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
    m.topLeftCorner(dof, dof) = covariance.topLeftCorner(dof, dof);
    return m;
  }();
  if (!P.allFinite()) return std::nullopt;
  const Eigen::LLT<Eigen::Matrix3d> llt(P);
  if (llt.info() != Eigen::Success) return std::nullopt;
  // The first steps from an exact start know a direction as good as exactly.
  const auto d = llt.matrixLLT().diagonal().head(dof).array().square();
  if (!(d.minCoeff() > 1e-9 * d.maxCoeff())) return std::nullopt;
  Eigen::Vector3d e = Eigen::Vector3d::Zero();
  e.head(dof) = error.head(dof);
  const Eigen::Vector3d z = llt.matrixL().solve(e);
  return z.allFinite() ? std::optional(z) : std::nullopt;
}

}  // namespace

void NormalizedErrors::add(double time_s, const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
                           bool has_heading) {
  const int dof = has_heading ? 3 : 2;
  if (dof_ != 0 && dof != dof_) return;
  const auto z = normalized(error, covariance, dof);
  if (!z) return;
  dof_ = dof;
  mean_ += (z->squaredNorm() - mean_) / static_cast<double>(count_ + 1);
  if (count_++ % stride_ != 0) return;
  kept_.push_back({time_s, *z});
  if (kept_.size() < most_) return;
  for (size_t i = 0; 2 * i < kept_.size(); ++i) kept_[i] = kept_[2 * i];
  kept_.resize((kept_.size() + 1) / 2);
  stride_ *= 2;
}

std::optional<double> NormalizedErrors::meanNees() const { return count_ > 0 ? std::optional(mean_) : std::nullopt; }

double NormalizedErrors::effectiveCount() const {
  const size_t n = kept_.size();
  if (n < 2) return static_cast<double>(n);
  const auto square = [&](size_t lag) {
    Eigen::Matrix3d C = Eigen::Matrix3d::Zero();
    for (size_t t = 0; t + lag < n; ++t) C.noalias() += kept_[t].z * kept_[t + lag].z.transpose();
    return C.squaredNorm();
  };
  const double whole = square(0);
  if (!(whole > 0)) return 1;
  double tau = 1;
  for (size_t lag = 1; lag < n && static_cast<double>(lag) < 3 * tau; ++lag) tau += 2 * square(lag) / whole;
  return std::max(1.0, static_cast<double>(n) / tau);
}

}  // namespace sidestep
