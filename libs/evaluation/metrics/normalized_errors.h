// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace sidestep {

/// Errors of a trajectory measured by the covariance that the filter believed in: z = P^-1/2 e, NEES = |z|^2.
///
/// Of a consistent filter NEES is chi-square with as many degrees of freedom as the error has components. Neighbouring
/// errors are correlated, so that the effective sample size of n of them is less than n:
///
///   n_eff = n / tau,   tau = 1 + 2 sum over lags l of rho(l)^2,   rho(l)^2 = |C(l)|^2 / |C(0)|^2
///
/// with C(l) the sample mean of z_t z_{t+l}' and |.| Frobenius' norm: the correlation of squares of Gaussians is the
/// square of theirs. The mean of z is known to be zero and is not estimated, which keeps short samples honest: an error
/// that stays the same through the whole run has n_eff of one or two. The sum ends at the first lag of 3 tau
/// (Sokal).
class NormalizedErrors {
 public:
  struct Sample {
    double time_s = 0;
    Eigen::Vector3d z = Eigen::Vector3d::Zero();  ///< the first dof() count
    double nees() const { return z.squaredNorm(); }
  };
  /// @param most  samples kept (evenly thinned) for the correlation and for pictures; all count for the mean
  explicit NormalizedErrors(size_t most = 500) : most_(most) {}

  /// @param error       (x, y, yaw) [m, rad], in the covariance's frame
  /// @param has_heading without it the first two components alone count. Samples of another kind than the first, and
  ///                    those whose covariance is not known or knows one direction exactly, are left out.
  void add(double time_s, const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance, bool has_heading);

  uint64_t count() const { return count_; }
  int dof() const { return dof_; }
  std::optional<double> meanNees() const;
  /// Effective sample size n_eff; at most as many as were kept.
  double effectiveCount() const;
  const std::vector<Sample>& kept() const { return kept_; }

 private:
  size_t most_;
  std::vector<Sample> kept_;
  size_t stride_ = 1;
  uint64_t count_ = 0;
  double mean_ = 0;
  int dof_ = 0;
};

}  // namespace sidestep
