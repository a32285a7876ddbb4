// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// How a particle filter comes by new particles: from a measurement when it is lost, from its own by their weights.
#include <algorithm>
#include <cmath>

#include "localization/filters/fast_math.h"
#include "localization/filters/particle_filter.h"

namespace sidestep {
namespace {

using Kind = Measurement::Kind;

constexpr double kMostSpread_m = 2, kMostSpread = 0.35;  // of one mode; roughening goes by no more

}  // namespace

// ---- recovery ----

/// A pose that the measurement would say is the robot's, in all else as particle `like`; the heading only half the
/// time.
mrpt::math::TPose2D ParticleFilter::drawFrom(const Measurement& m, Eigen::Index like) {
  mrpt::math::TPose2D p{cloud_.x[like], cloud_.y[like], cloud_.yaw[like]};
  Eigen::Vector3d e;
  random_.gaussians(e.data(), 3);
  e = m.R.diagonal().cwiseMax(0).cwiseSqrt().cwiseProduct(e);
  const double any = random_.uniform(-M_PI, M_PI), offset = m.heading_has_offset ? cloud_.offset[like] : 0;
  if (m.tellsHeading())
    p.phi = wrapAngle(m.z(m.size() - 1) - offset + e(m.size() - 1));
  else if (random_.uniform() < 0.5)
    p.phi = any;
  if (m.kind == Kind::kHeading) return p;
  const double c = std::cos(p.phi), s = std::sin(p.phi);
  const double lever_x = c * m.p_base_sensor.x() - s * m.p_base_sensor.y();
  const double lever_y = s * m.p_base_sensor.x() + c * m.p_base_sensor.y();
  mrpt::math::TPoint2D sensor{m.z(0) + e(0), m.z(1) + e(1)};
  if (m.kind == Kind::kRange) {
    const double dz = m.p_base_sensor.z() - m.p_map_beacon.z(), r = m.z(0) + e(0);
    const double ground = std::sqrt(std::max(0.0, r * r - dz * dz));
    const double towards = random_.uniform() < 0.5
                               ? random_.uniform(-M_PI, M_PI)
                               : std::atan2(p.y + lever_y - m.p_map_beacon.y(), p.x + lever_x - m.p_map_beacon.x());
    sensor = {m.p_map_beacon.x() + ground * std::cos(towards), m.p_map_beacon.y() + ground * std::sin(towards)};
  }
  p.x = sensor.x - lever_x;
  p.y = sensor.y - lever_y;
  return p;
}

void ParticleFilter::makeRoom(size_t count, double share) {
  const size_t n = cloud_.size(), kept = n - std::min(count, n - 1);
  resampler_.draw(scheme_, cloud_.weight.data(), n, kept, random_, indices_.data());
  cloud_.select(indices_.data(), kept);
  cloud_.resize(n);
  for (size_t k = kept; k < n; ++k) {
    const auto i = static_cast<Eigen::Index>(k), like = static_cast<Eigen::Index>(random_.below(kept));
    for (auto* a : {&cloud_.offset, &cloud_.bias, &cloud_.scale}) (*a)[i] = (*a)[like];
  }
  if (kept == n) return cloud_.equalWeights();
  const auto old = static_cast<Eigen::Index>(kept), made = static_cast<Eigen::Index>(n - kept);
  cloud_.weight.head(old).setConstant((1 - share) / static_cast<double>(kept));
  cloud_.weight.segment(old, made).setConstant(share / static_cast<double>(n - kept));
}

void ParticleFilter::inject(const Measurement& m) {
  const size_t n = cloud_.size();
  const auto count = static_cast<size_t>(params_.recovery_share * static_cast<double>(n));
  makeRoom(count, params_.recovery_share);
  for (size_t k = n - count; k < n; ++k) {
    const auto i = static_cast<Eigen::Index>(k), like = static_cast<Eigen::Index>(random_.below(n - count));
    const auto p = drawFrom(m, like);
    cloud_.x[i] = p.x;
    cloud_.y[i] = p.y;
    cloud_.yaw[i] = p.phi;
    for (auto* a : {&cloud_.offset, &cloud_.bias, &cloud_.scale}) (*a)[i] = (*a)[like];
  }
}

// ---- resampling ----

size_t ParticleFilter::wantedSize(size_t drawn) {
  const auto& r = params_.resampling;
  cells_.clear();
  for (size_t k = 0; k < drawn; ++k) {
    if (k > 0 && indices_[k] == indices_[k - 1]) continue;
    const auto i = static_cast<Eigen::Index>(indices_[k]);
    cells_.add(cloud_.x[i], cloud_.y[i], cloud_.yaw[i], r.kld_cell_m, r.kld_cell);
  }
  const double n = kldSampleSize(cells_.count(), r.kld_error, r.kld_quantile);
  return static_cast<size_t>(
      std::clamp(n, static_cast<double>(std::min(r.kld_min, r.kld_max)), static_cast<double>(r.kld_max)));
}

void ParticleFilter::resample() {
  size_t count = cloud_.size();
  resampler_.draw(scheme_, cloud_.weight.data(), cloud_.size(), count, random_, indices_.data());
  if (params_.resampling.kld) {
    count = wantedSize(count);
    resampler_.draw(scheme_, cloud_.weight.data(), cloud_.size(), count, random_, indices_.data());
  }
  cloud_.select(indices_.data(), count);
  if (params_.resampling.roughening > 0) roughen(count);
}

/// Noise on all copies of a particle but the first, by the spread of the cloud in each component.
void ParticleFilter::roughen(size_t count) {
  const auto n = static_cast<Eigen::Index>(count);
  const double share = 1 / static_cast<double>(count);
  const auto spread = [&](const Eigen::ArrayXd& a, double reference) {
    const auto d = a.head(n) - reference;
    const double mean = d.sum() * share;
    return std::sqrt(std::max(0.0, d.square().sum() * share - mean * mean));
  };
  auto turns = likelihoods();  // free by now
  const double first = cloud_.yaw[0];
  const double* __restrict yaw = cloud_.yaw.data();
  double* __restrict t = likelihood_.data();
  for (Eigen::Index i = 0; i < n; ++i) t[i] = wrapAngle(yaw[i] - first);
  const double mean = turns.sum() * share;
  const double r = params_.resampling.roughening;
  const double sd_x = r * std::min(kMostSpread_m, spread(cloud_.x, cloud_.x[0]));
  const double sd_y = r * std::min(kMostSpread_m, spread(cloud_.y, cloud_.y[0]));
  const double sd_yaw = r * std::min(kMostSpread, std::sqrt(std::max(0.0, turns.square().sum() * share - mean * mean)));
  const bool learns = cloud_.learnsMotion();
  const double sd_bias = learns ? r * spread(cloud_.bias, cloud_.bias[0]) : 0;
  const double sd_scale = learns ? r * spread(cloud_.scale, cloud_.scale[0]) : 0;
  for (size_t k = 1; k < count; ++k) {
    if (indices_[k] != indices_[k - 1]) continue;
    const auto i = static_cast<Eigen::Index>(k);
    double g[5];
    random_.gaussians(g, learns ? 5 : 3);
    if (learns) {
      cloud_.bias[i] += sd_bias * g[3];
      cloud_.scale[i] += sd_scale * g[4];
    }
    cloud_.x[i] += sd_x * g[0];
    cloud_.y[i] += sd_y * g[1];
    cloud_.yaw[i] = wrapAngle(cloud_.yaw[i] + sd_yaw * g[2]);
  }
}

std::vector<PoseMode> ParticleFilter::modes() const {
  const auto& r = params_.resampling;
  const Eigen::Matrix3d P = cloud_.belief().covariance;
  const double narrowing = std::pow(static_cast<double>(cloud_.size()), -1.0 / 7);
  const double cell_m = narrowing * std::sqrt(std::max(P(0, 0), P(1, 1))), cell = narrowing * std::sqrt(P(2, 2));
  return cloud_.modes(std::max(2 * r.kld_cell_m, cell_m), std::max(2 * r.kld_cell, cell), 0.01);
}

}  // namespace sidestep
