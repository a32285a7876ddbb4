// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/resampling.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/errors.h"

namespace sidestep {
namespace {

/// For ascending positions in [0, 1): the particle in whose share of the unit interval each lies.
template <typename Position>
void walk(const double* weights, size_t n, size_t count, uint32_t* out, Position position) {
  size_t j = 0;
  double reached = weights[0];
  for (size_t i = 0; i < count; ++i) {
    const double p = position(i);
    while (reached <= p && j + 1 < n) reached += weights[++j];
    out[i] = static_cast<uint32_t>(j);
  }
  // Q(N) = 1 of algorithm 4: rounding must not choose a particle at the end that weighs nothing.
  size_t last = n;
  while (last > 1 && !(weights[last - 1] > 0)) --last;
  for (size_t i = count; i-- > 0 && out[i] >= last;) out[i] = static_cast<uint32_t>(last - 1);
}

}  // namespace

void ResamplingParams::visit(ParamVisitor& v) {
  v.choice("scheme", scheme, {"multinomial", "systematic", "stratified", "residual"},
           "how particles are drawn; multinomial as in algorithm 4");
  v.flag("each_step", each_step, "draw after each measurement, as printed; else when the effective sample size is low");
  v.number("ess_share", ess_share, {0, 1}, "", "low: under this share of the particles");
  v.number("roughening", roughening, {0, 1}, "",
           "noise on copies of a particle, by the spread of all, so that a robot at rest keeps distinct particles; 0 = "
           "none");
  v.flag("kld", kld, "adapt the number of particles to the spread (Fox 2003)");
  v.integer("kld_min", kld_min, {10, 1000000}, "fewest particles");
  v.integer("kld_max", kld_max, {10, 1000000}, "most particles");
  v.number("kld_error", kld_error, {0.0001, 1}, "", "Kullback-Leibler divergence allowed");
  v.number("kld_quantile", kld_quantile, {0, 6}, "", "normal quantile of the probability that it is kept");
  v.number("kld_cell_m", kld_cell_m, {0.01, 100}, "m", "size of a cell in x and y");
  v.angle("kld_cell_deg", kld_cell, {0.1, 180}, "size of a cell in yaw");
}

ResamplingScheme resamplingScheme(const std::string& word) {
  if (word == "multinomial") return ResamplingScheme::kMultinomial;
  if (word == "systematic") return ResamplingScheme::kSystematic;
  if (word == "stratified") return ResamplingScheme::kStratified;
  if (word == "residual") return ResamplingScheme::kResidual;
  throw ConfigError("resampling.scheme: '" + word + "' is none of multinomial, systematic, stratified, residual");
}

void Resampler::reserve(size_t most) {
  uniforms_.resize(static_cast<Eigen::Index>(most) + 1);
  residues_.resize(static_cast<Eigen::Index>(most));
}

/// Order statistics of `count` uniforms: partial sums of count + 1 exponentials by their total.
void Resampler::sortedUniforms(size_t count, Random& random) {
  auto spacings = uniforms_.head(static_cast<Eigen::Index>(count) + 1);
  for (auto& u : spacings) u = 1 - random.uniform();
  spacings = -spacings.log();
  double sum = 0;
  for (auto& u : spacings) u = sum += u;
  spacings *= 1 / sum;
}

void Resampler::draw(ResamplingScheme scheme, const double* weights, size_t n, size_t count, Random& random,
                     uint32_t* out) {
  const double share = 1 / static_cast<double>(count);
  switch (scheme) {
    case ResamplingScheme::kMultinomial:
      sortedUniforms(count, random);
      return walk(weights, n, count, out, [this](size_t i) { return uniforms_[static_cast<Eigen::Index>(i)]; });
    case ResamplingScheme::kSystematic: {
      const double u = random.uniform();
      return walk(weights, n, count, out, [=](size_t i) { return (static_cast<double>(i) + u) * share; });
    }
    case ResamplingScheme::kStratified:
      return walk(weights, n, count, out,
                  [&](size_t i) { return (static_cast<double>(i) + random.uniform()) * share; });
    case ResamplingScheme::kResidual:
      return residual(weights, n, count, random, out);
  }
}

void Resampler::residual(const double* weights, size_t n, size_t count, Random& random, uint32_t* out) {
  double* rest = residues_.data();
  size_t certain = 0;
  double sum = 0;
  const double total = static_cast<double>(count);
  for (size_t j = 0; j < n; ++j) {
    // Whole but for rounding is whole: 500 equal weights are 500 certain copies.
    const double copies = std::floor(total * weights[j] + 1e-9);
    certain += static_cast<size_t>(copies);
    rest[j] = std::max(0.0, total * weights[j] - copies);
    sum += rest[j];
  }
  const size_t drawn = count > certain ? count - certain : 0;
  if (drawn > 0 && sum > 0) {
    for (size_t j = 0; j < n; ++j) rest[j] /= sum;
    sortedUniforms(drawn, random);
    walk(rest, n, drawn, out + certain, [this](size_t i) { return uniforms_[static_cast<Eigen::Index>(i)]; });
  }
  // Merge: the drawn ones lie ascending at the end, the writing place never overtakes the reading place.
  size_t read = count - drawn, write = 0;
  for (size_t j = 0; j < n; ++j) {
    size_t copies = static_cast<size_t>(std::floor(total * weights[j] + 1e-9));
    for (; read < count && out[read] == j; ++read) ++copies;
    for (; copies > 0 && write < count; --copies) out[write++] = static_cast<uint32_t>(j);
  }
  for (; write < count; ++write) out[write] = write > 0 ? out[write - 1] : 0;
}

double effectiveSampleSize(const double* weights, size_t n) {
  const double squares = Eigen::Map<const Eigen::ArrayXd>(weights, static_cast<Eigen::Index>(n)).square().sum();
  return squares > 0 ? 1 / squares : 0;
}

double kldSampleSize(size_t bins, double error, double quantile) {
  if (bins < 2) return 1;
  const double k = static_cast<double>(bins - 1), a = 2 / (9 * k);
  return k / (2 * error) * std::pow(std::max(0.0, 1 - a + std::sqrt(a) * quantile), 3);
}

void CellCounter::reserve(size_t most) {
  slots_.assign(std::bit_ceil(2 * most + 2), Slot());
  generation_ = 0;
  clear();
}

void CellCounter::clear() {
  if (++generation_ == 0) {  // once in four thousand million times
    std::fill(slots_.begin(), slots_.end(), Slot());
    generation_ = 1;
  }
  count_ = 0;
}

bool CellCounter::add(double x, double y, double yaw, double cell_m, double cell_rad) {
  const auto part = [](double v, double cell) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(v / cell))) & 0x1fffff;
  };
  const uint64_t key = part(x, cell_m) | part(y, cell_m) << 21 | part(yaw, cell_rad) << 42;
  const size_t mask = slots_.size() - 1;
  size_t i = (key * 0x9e3779b97f4a7c15 >> 20) & mask;
  while (slots_[i].generation == generation_) {
    if (slots_[i].key == key) return false;
    i = (i + 1) & mask;
  }
  slots_[i] = {key, generation_};
  ++count_;
  return true;
}

}  // namespace sidestep
