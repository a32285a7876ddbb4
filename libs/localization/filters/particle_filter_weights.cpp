// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What each particle would have measured, and what its weight becomes.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "localization/filters/fast_math.h"
#include "localization/filters/particle_filter.h"

namespace sidestep {
namespace {

using Kind = Measurement::Kind;

}  // namespace

// ---- innovations ----

void ParticleFilter::positionInnovations(const Measurement& m) {
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  const double ahead = m.p_base_sensor.x(), left = m.p_base_sensor.y();
  if (ahead == 0 && left == 0) {
    row(0) = m.z(0) - cloud_.x.head(n);
    row(1) = m.z(1) - cloud_.y.head(n);
    return;
  }
  const double* __restrict x = cloud_.x.data(), * __restrict y = cloud_.y.data(), * __restrict yaw = cloud_.yaw.data();
  double* __restrict nu_x = nu_[0].data(), * __restrict nu_y = nu_[1].data();
  const double zx = m.z(0), zy = m.z(1);
  for (Eigen::Index i = 0; i < n; ++i) {
    double s, c;
    sineCosine(yaw[i], s, c);
    nu_x[i] = zx - (x[i] + c * ahead - s * left);
    nu_y[i] = zy - (y[i] + s * ahead + c * left);
  }
}

void ParticleFilter::headingInnovations(const Measurement& m, int k) {
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  const double* __restrict yaw = cloud_.yaw.data(), * __restrict offset = cloud_.offset.data();
  double* __restrict nu = nu_[static_cast<size_t>(k)].data();
  const double z = wrapAngle(m.z(k)), take = m.heading_has_offset ? 1 : 0;
  for (Eigen::Index i = 0; i < n; ++i) nu[i] = wrapAngle(z - yaw[i] - take * offset[i]);
}

void ParticleFilter::rangeInnovations(const Measurement& m) {
  positionInnovations(m);  // of z = (range, 0): only the sensor's place in them is wanted
  const double bx = m.z(0) - m.p_map_beacon.x(), by = m.z(1) - m.p_map_beacon.y();
  const double dz = m.p_base_sensor.z() - m.p_map_beacon.z();
  row(0) = m.z(0) - ((bx - row(0)).square() + (by - row(1)).square() + dz * dz).sqrt();
}

void ParticleFilter::innovations(const Measurement& m) {
  switch (m.kind) {
    case Kind::kPositionHeading:
      headingInnovations(m, 2);
      [[fallthrough]];
    case Kind::kPosition:
      return positionInnovations(m);
    case Kind::kHeading:
      return headingInnovations(m, 0);
    case Kind::kRange:
      return rangeInnovations(m);
    case Kind::kStill:
      row(0) = m.z(0) - cloud_.bias.head(static_cast<Eigen::Index>(cloud_.size()));
      return;
    case Kind::kScan:
      return;
  }
}

/// R, and what is not known, given a particle's path, of a heading's offset or the gyro's bias.
Eigen::Matrix3d ParticleFilter::noise(const Measurement& m) const {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  const int n = m.size();
  R.topLeftCorner(n, n) = m.R.topLeftCorner(n, n);
  R.diagonal() = R.diagonal().cwiseMax(kLeastVariance);
  if (m.tellsHeading() && m.heading_has_offset) R(n - 1, n - 1) += offset_var_;
  if (m.kind == Kind::kStill) R(0, 0) += bias_var_;
  return R;
}

/// Covariance of the innovations over the cloud, and their mean.
Eigen::Matrix3d ParticleFilter::meanSquares(int size, Eigen::Vector3d& mean) const {
  const auto w = cloud_.weights();
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  mean.setZero();
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  for (int a = 0; a < size; ++a) mean(a) = (w * row(a)).sum();
  for (int a = 0; a < size; ++a)
    for (int b = 0; b <= a; ++b) {
      const double *u = nu_[static_cast<size_t>(a)].data(), *v = nu_[static_cast<size_t>(b)].data();
      PairSum sum;
      forPairs(n, [&](Eigen::Index i, auto lane) {
        sum.add(at(cloud_.weight.data(), i, lane) * (at(u, i, lane) - mean(a)) * (at(v, i, lane) - mean(b)));
      });
      out(a, b) = out(b, a) = sum.total();
    }
  return out;
}

// ---- weights ----

void ParticleFilter::weighByGaussian(int size, const Eigen::Matrix3d& R) {
  const Eigen::Matrix3d W = R.inverse();
  auto q = likelihoods();
  if (size == 1)
    q = -0.5 * W(0, 0) * row(0).square();
  else if (size == 2)
    q = -0.5 * W(0, 0) * row(0).square() - W(0, 1) * row(0) * row(1) - 0.5 * W(1, 1) * row(1).square();
  else
    q = -0.5 * (row(0) * (W(0, 0) * row(0) + 2 * W(0, 1) * row(1) + 2 * W(0, 2) * row(2)) +
                row(1) * (W(1, 1) * row(1) + 2 * W(1, 2) * row(2)) + W(2, 2) * row(2).square());
  double* __restrict l = likelihood_.data();
  for (Eigen::Index i = 0; i < q.size(); ++i) l[i] = weightExp(l[i]);
}

/// Algorithm 3, lines 12-18; the factor |2 pi R|^-1/2 is the same for all particles.
void ParticleFilter::weighAsPrinted(int size) {
  auto q = likelihoods();
  q = row(0).square();
  for (int k = 1; k < size; ++k) q += row(k).square();
  q = (-0.5 * (0.2 * q.max(1e-300).log()).exp()).exp();
}

void ParticleFilter::multiplyWeights(double floor) {
  auto w = cloud_.weights();
  w *= likelihoods() + floor;
  const double sum = w.sum();
  if (sum > 0 && std::isfinite(sum))
    w *= 1 / sum;
  else
    cloud_.equalWeights();
}

}  // namespace sidestep
