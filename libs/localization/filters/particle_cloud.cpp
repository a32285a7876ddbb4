// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/particle_cloud.h"

#include <mrpt/poses/CPosePDFParticles.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "localization/filters/fast_math.h"

namespace sidestep {
namespace {

/// A square root of a covariance that may be singular: V sqrt(D).
Eigen::Matrix3d squareRoot(const Eigen::Matrix3d& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// Numbers of cells of (x, y, yaw): 24 bits each for x and y, 16 for the yaw, which goes round.
class CellKeys {
 public:
  CellKeys(double cell_m, double cell_rad)
      : cell_m_(cell_m), turns_(std::max<int64_t>(1, std::llround(2 * M_PI / cell_rad))) {}
  uint64_t of(double x, double y, double yaw) const {
    const auto a = static_cast<int64_t>(std::floor((yaw + M_PI) / (2 * M_PI) * static_cast<double>(turns_)));
    return pack(std::llround(std::floor(x / cell_m_)), std::llround(std::floor(y / cell_m_)), a);
  }
  /// The k-th of the 26 neighbours and itself.
  uint64_t near(uint64_t key, int k) const {
    return pack(static_cast<int64_t>(key >> 40) + k / 3 % 3 - 1, static_cast<int64_t>(key >> 16 & 0xffffff) + k % 3 - 1,
                static_cast<int64_t>(key & 0xffff) + k / 9 - 1);
  }

 private:
  uint64_t pack(int64_t ix, int64_t iy, int64_t a) const {
    return (static_cast<uint64_t>(ix) & 0xffffff) << 40 | (static_cast<uint64_t>(iy) & 0xffffff) << 16 |
           static_cast<uint64_t>((a + turns_) % turns_);
  }
  double cell_m_;
  int64_t turns_;
};

/// For each of the sorted cells the number of the connected group that it belongs to.
std::vector<uint32_t> connected(const std::vector<uint64_t>& cells, const CellKeys& keys) {
  constexpr uint32_t kNone = 0xffffffff;
  std::vector<uint32_t> group(cells.size(), kNone);
  uint32_t groups = 0;
  std::vector<size_t> open;
  for (size_t first = 0; first < cells.size(); ++first) {
    if (group[first] != kNone) continue;
    group[first] = groups;
    open.push_back(first);
    while (!open.empty()) {
      const uint64_t cell = cells[open.back()];
      open.pop_back();
      for (int k = 0; k < 27; ++k) {
        const auto it = std::lower_bound(cells.begin(), cells.end(), keys.near(cell, k));
        const auto at = static_cast<size_t>(it - cells.begin());
        if (it == cells.end() || *it != keys.near(cell, k) || group[at] != kNone) continue;
        group[at] = groups;
        open.push_back(at);
      }
    }
    ++groups;
  }
  return group;
}

}  // namespace

void ParticleCloud::reserve(size_t most) {
  const auto n = static_cast<Eigen::Index>(most);
  for (auto* a : {&x, &y, &yaw, &offset, &weight, &bias, &scale, &spare_x_, &spare_y_, &spare_yaw_, &spare_offset_})
    a->conservativeResize(n);
  for (auto* a : {&bias, &scale}) a->setZero();
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
  for (auto* a : {&offset, &bias, &scale}) a->head(length()).setZero();
  equalWeights();
}

/// Turns the noise into how much farther each particle goes, turns, than the step says, and lets it learn from that
/// what its scale and bias are: given its path they are Gaussian, with a variance that is common to all
/// (Rao-Blackwell).
void ParticleCloud::learnFromNoise(const MotionStep& motion, const MotionNoise& noise) {
  const Eigen::Index n = length();
  double* __restrict g = gaussians_.data();
  double* __restrict b = bias.data(), * __restrict s = scale.data();
  const double distance = motion.distance_m, dt = motion.turn_from_gyro ? motion.dt_s : 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double far = g[i], turned = g[n + i];
    g[i] = distance * s[i] + noise.distance_sd * far;
    g[n + i] = noise.turn_sd * turned - dt * b[i];
    s[i] += noise.scale_gain * far;
    b[i] -= noise.bias_gain * turned;
  }
}

void ParticleCloud::move(const MotionStep& motion, const MotionNoise& noise, Random& random) {
  const Eigen::Index n = length();
  double* __restrict g = gaussians_.data();
  random.gaussians(g, static_cast<size_t>(noise.final_turn_sd > 0 ? 3 * n : 2 * n));
  if (learns_motion_) learnFromNoise(motion, noise);
  double* __restrict px = x.data(), * __restrict py = y.data(), * __restrict pyaw = yaw.data();
  const double distance = motion.distance_m, turn = motion.turn_rad;
  const double distance_sd = learns_motion_ ? 1 : noise.distance_sd, turn_sd = learns_motion_ ? 1 : noise.turn_sd;
  const double final_sd = noise.final_turn_sd;
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
  if (learns_motion_) {
    for (auto* a : {&bias, &scale}) {
      for (size_t k = 0; k < count; ++k)
        spare_offset_[static_cast<Eigen::Index>(k)] = (*a)[static_cast<Eigen::Index>(indices[k])];
      a->swap(spare_offset_);
    }
  }
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

std::vector<PoseMode> ParticleCloud::modes(double cell_m, double cell_rad, double least, size_t most) const {
  const CellKeys keys(cell_m, cell_rad);
  std::vector<uint64_t> of(size_);
  for (size_t k = 0; k < size_; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    of[k] = keys.of(x[i], y[i], yaw[i]);
  }
  std::vector<uint64_t> cells = of;
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const auto group = connected(cells, keys);
  std::vector<double> weight_of(cells.size(), 0);
  std::vector<uint32_t> group_of(size_);
  for (size_t k = 0; k < size_; ++k) {
    const auto at = static_cast<size_t>(std::lower_bound(cells.begin(), cells.end(), of[k]) - cells.begin());
    group_of[k] = group[at];
    weight_of[group[at]] += weight[static_cast<Eigen::Index>(k)];
  }
  std::vector<uint32_t> heavy;
  for (uint32_t g = 0; g < weight_of.size(); ++g)
    if (weight_of[g] >= least && weight_of[g] > 0) heavy.push_back(g);
  std::stable_sort(heavy.begin(), heavy.end(), [&](auto a, auto b) { return weight_of[a] > weight_of[b]; });
  if (heavy.size() > most) heavy.resize(most);
  std::vector<PoseMode> out;
  Eigen::ArrayXd share(length());
  for (const uint32_t g : heavy) {
    for (size_t k = 0; k < size_; ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      share[i] = group_of[k] == g ? weight[i] / weight_of[g] : 0;
    }
    out.push_back({weight_of[g], beliefOf(share)});
  }
  return out;
}

PoseMode ParticleCloud::densest(double cell_m, double cell_rad) const {
  const CellKeys keys(cell_m, cell_rad);
  std::vector<std::pair<uint64_t, uint32_t>> cells(size_);
  for (size_t k = 0; k < size_; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    cells[k] = {keys.of(x[i], y[i], yaw[i]), static_cast<uint32_t>(k)};
  }
  std::sort(cells.begin(), cells.end());
  double best = -1;
  Eigen::Index centre = 0;
  for (size_t k = 0; k < size_;) {
    const size_t first = k;
    double sum = 0;
    for (; k < size_ && cells[k].first == cells[first].first; ++k) sum += weight[cells[k].second];
    if (sum > best) {
      best = sum;
      centre = cells[first].second;
    }
  }
  PoseMode out{best, {}};
  out.belief.mean = {x[centre], y[centre], yaw[centre]};
  Eigen::ArrayXd share(length());
  for (int round = 0; round < 2; ++round) {
    const auto& c = out.belief.mean;
    for (Eigen::Index i = 0; i < length(); ++i) {
      const bool near = std::abs(x[i] - c.x) < 2 * cell_m && std::abs(y[i] - c.y) < 2 * cell_m &&
                        std::abs(wrapAngle(yaw[i] - c.phi)) < 2 * cell_rad;
      share[i] = near ? weight[i] : 0;
    }
    out.weight = share.sum();
    if (!(out.weight > 0)) return {best, belief()};
    share /= out.weight;
    out.belief = beliefOf(share);
  }
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
