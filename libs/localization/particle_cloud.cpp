// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/particle_cloud.h"

#include <mrpt/poses/CPosePDFParticles.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "localization/fast_math.h"

namespace sidestep {
namespace {

/// A square root of a covariance that may be singular: V sqrt(D).
Eigen::Matrix3d squareRoot(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

}  // namespace

void ParticleCloud::reserve(size_t most) {
  const auto n = static_cast<Eigen::Index>(most);
  for (auto* a : {&x, &y, &yaw, &offset, &weight, &spare_x_, &spare_y_, &spare_yaw_, &spare_offset_})
    a->conservativeResize(n);
  gaussians_.resize(3 * n);
  size_ = std::min(size_, most);
}

void ParticleCloud::equalWeights() { weights().setConstant(1 / static_cast<double>(size_)); }

void ParticleCloud::draw(const PoseBelief& belief, size_t count, Random& random) {
  size_ = std::min(count, capacity());
  const Eigen::Matrix3d root = squareRoot(belief.covariance);
  for (Eigen::Index i = 0; i < length(); ++i) {
    Eigen::Vector3d g;
    random.gaussians(g.data(), 3);
    const Eigen::Vector3d d = root * g;
    x[i] = belief.mean.x + d.x();
    y[i] = belief.mean.y + d.y();
    yaw[i] = wrapAngle(belief.mean.phi + d.z());
  }
  offset.head(length()).setZero();
  equalWeights();
}

void ParticleCloud::move(const MotionStep& motion, const MotionNoise& noise, Random& random) {
  const Eigen::Index n = length();
  double* __restrict g = gaussians_.data();
  random.gaussians(g, static_cast<size_t>(noise.final_turn_sd > 0 ? 3 * n : 2 * n));
  double* __restrict px = x.data(), * __restrict py = y.data(), * __restrict pyaw = yaw.data();
  const double distance = motion.distance_m, turn = motion.turn_rad;
  const double distance_sd = noise.distance_sd, turn_sd = noise.turn_sd, final_sd = noise.final_turn_sd;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double d = distance + distance_sd * g[i], t = turn + turn_sd * g[n + i];
    double s, c;
    sineCosine(pyaw[i] + 0.5 * t, s, c);
    px[i] += d * c;
    py[i] += d * s;
    pyaw[i] = wrapAngle(pyaw[i] + t);
  }
  if (final_sd > 0)
    for (Eigen::Index i = 0; i < n; ++i) pyaw[i] = wrapAngle(pyaw[i] + final_sd * g[2 * n + i]);
}

void ParticleCloud::select(const uint32_t* indices, size_t count) {
  for (size_t k = 0; k < count; ++k) {
    const auto i = static_cast<Eigen::Index>(k), j = static_cast<Eigen::Index>(indices[k]);
    spare_x_[i] = x[j];
    spare_y_[i] = y[j];
    spare_yaw_[i] = yaw[j];
    spare_offset_[i] = offset[j];
  }
  x.swap(spare_x_);
  y.swap(spare_y_);
  yaw.swap(spare_yaw_);
  offset.swap(spare_offset_);
  size_ = count;
  equalWeights();
}

PoseBelief ParticleCloud::belief() const { return beliefOf(weights()); }

/// Sums are taken relative to the first particle: coordinates may be thousands of times the spread.
PoseBelief ParticleCloud::beliefOf(const Eigen::Ref<const Eigen::ArrayXd>& w) const {
  PairSum sine, cosine, east, north;
  const double x0 = x[0], y0 = y[0];
  forPairs(length(), [&](Eigen::Index i, auto lane) {
    using T = decltype(lane);
    const T wi = at(w.data(), i, lane);
    T s, c;
    sineCosine<T>(at(yaw.data(), i, lane), s, c);
    sine.add(wi * s);
    cosine.add(wi * c);
    east.add(wi * (at(x.data(), i, lane) - x0));
    north.add(wi * (at(y.data(), i, lane) - y0));
  });
  PoseBelief out;
  out.mean = {x0 + east.total(), y0 + north.total(), std::atan2(sine.total(), cosine.total())};
  PairSum xx, xy, yy, xa, ya, aa;
  forPairs(length(), [&](Eigen::Index i, auto lane) {
    using T = decltype(lane);
    const T wi = at(w.data(), i, lane), dx = at(x.data(), i, lane) - out.mean.x;
    const T dy = at(y.data(), i, lane) - out.mean.y, da = wrapAngle<T>(at(yaw.data(), i, lane) - out.mean.phi);
    const T wx = wi * dx, wy = wi * dy;
    xx.add(wx * dx);
    xy.add(wx * dy);
    yy.add(wy * dy);
    xa.add(wx * da);
    ya.add(wy * da);
    aa.add(wi * da * da);
  });
  out.covariance << xx.total(), xy.total(), xa.total(), xy.total(), yy.total(), ya.total(), xa.total(), ya.total(),
      aa.total();
  return out;
}

std::vector<PoseMode> ParticleCloud::modes(double cell_m, double cell_rad, double least) const {
  using Cell = std::tuple<int64_t, int64_t, int64_t>;
  const int64_t turns = std::max<int64_t>(1, static_cast<int64_t>(std::lround(2 * M_PI / cell_rad)));
  const auto cellOf = [&](Eigen::Index i) {
    const auto a = static_cast<int64_t>(std::floor((yaw[i] + M_PI) / (2 * M_PI) * static_cast<double>(turns)));
    return Cell(std::llround(std::floor(x[i] / cell_m)), std::llround(std::floor(y[i] / cell_m)), a % turns);
  };
  std::map<Cell, int> group;
  std::vector<int> of(size_);
  for (Eigen::Index i = 0; i < length(); ++i) group.emplace(cellOf(i), -1);
  int groups = 0;
  for (auto& [start, number] : group) {
    if (number >= 0) continue;
    number = groups++;
    std::vector<Cell> open = {start};
    while (!open.empty()) {
      const auto [cx, cy, ca] = open.back();
      open.pop_back();
      for (int k = 0; k < 27; ++k) {
        const auto near = group.find({cx + k % 3 - 1, cy + k / 3 % 3 - 1, (ca + k / 9 - 1 + turns) % turns});
        if (near == group.end() || near->second >= 0) continue;
        near->second = number;
        open.push_back(near->first);
      }
    }
  }
  std::vector<double> weight_of(static_cast<size_t>(groups), 0);
  for (Eigen::Index i = 0; i < length(); ++i) {
    of[static_cast<size_t>(i)] = group.at(cellOf(i));
    weight_of[static_cast<size_t>(of[static_cast<size_t>(i)])] += weight[i];
  }
  std::vector<PoseMode> out;
  Eigen::ArrayXd share(length());
  for (int g = 0; g < groups; ++g) {
    const double sum = weight_of[static_cast<size_t>(g)];
    if (!(sum >= least) || !(sum > 0)) continue;
    for (Eigen::Index i = 0; i < length(); ++i) share[i] = of[static_cast<size_t>(i)] == g ? weight[i] / sum : 0;
    out.push_back({sum, beliefOf(share)});
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  return out;
}

std::shared_ptr<mrpt::poses::CPosePDFParticles> toMrpt(const ParticleCloud& cloud) {
  auto out = std::make_shared<mrpt::poses::CPosePDFParticles>(cloud.size());
  for (size_t k = 0; k < cloud.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    out->m_particles[k].d = {cloud.x[i], cloud.y[i], cloud.yaw[i]};
    out->m_particles[k].log_w = std::log(std::max(cloud.weight[i], 1e-300));
  }
  return out;
}

}  // namespace sidestep
