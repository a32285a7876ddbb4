// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/params.h"
#include "core/random.h"

namespace sidestep {

/// How the next generation of particles is drawn, and how large it is.
struct ResamplingParams {
  std::string scheme = "systematic";
  bool each_step = false;
  double ess_share = 0.5;
  double roughening = 0.1;
  bool kld = false;
  int kld_min = 100, kld_max = 20000;
  double kld_error = 0.02;
  double kld_quantile = 2.326;  // of the normal distribution: 99 %
  double kld_cell_m = 0.25;
  double kld_cell = 0.174532925199432957;  // rad

  void visit(ParamVisitor& v);
};

enum class ResamplingScheme { kMultinomial, kSystematic, kStratified, kResidual };
/// @throws ConfigError if the word names none.
ResamplingScheme resamplingScheme(const std::string& word);

/// Draws with replacement which of `n` particles live on, each in proportion to its weight. No allocation once
/// `reserve` has been called with the largest sizes; O(n + count).
///
///   multinomial  independent draws (dissertation, algorithm 4), through sorted uniforms instead of a search for each
///   systematic   one uniform for all, (u + i) / count                                            (Kitagawa 1996)
///   stratified   one uniform in each of `count` equal strata
///   residual     floor(count * weight) copies of each, the rest multinomial                      (Liu & Chen 1998)
class Resampler {
 public:
  void reserve(size_t most);
  /// @param weights  >= 0, with a sum of 1 within rounding; `n` of them
  /// @param out      `count` indices, ascending
  void draw(ResamplingScheme scheme, const double* weights, size_t n, size_t count, Random& random, uint32_t* out);

 private:
  void sortedUniforms(size_t count, Random& random);
  void residual(const double* weights, size_t n, size_t count, Random& random, uint32_t* out);

  Eigen::ArrayXd uniforms_, residues_;
};

/// Effective sample size 1 / sum(w^2) of `n` weights whose sum is 1.
double effectiveSampleSize(const double* weights, size_t n);

/// Particles needed so that, with the probability of the normal quantile `quantile`, the Kullback-Leibler divergence of
/// the sample from a distribution over `bins` bins stays under `error` (Fox 2003, eq. 7).
double kldSampleSize(size_t bins, double error, double quantile);

/// Counts distinct cells of (x, y, yaw) without allocating: a hash table that is emptied by counting its generation up.
class CellCounter {
 public:
  void reserve(size_t most);
  void clear();
  /// True if the cell was not seen since `clear`.
  bool add(double x, double y, double yaw, double cell_m, double cell_rad);
  size_t count() const { return count_; }

 private:
  struct Slot {
    uint64_t key = 0;
    uint32_t generation = 0;
  };
  std::vector<Slot> slots_;
  uint32_t generation_ = 0;
  size_t count_ = 0;
};

}  // namespace sidestep
