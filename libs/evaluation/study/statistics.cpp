// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace sidestep {
namespace {

constexpr size_t kResamples = 2000;
constexpr size_t kExactUpTo = 12;
constexpr int kFlips = 9999;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double meanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double exactPValue(std::span<const double> d, double limit) {
  const size_t patterns = size_t{1} << d.size();
  size_t hits = 0;
  for (size_t pattern = 0; pattern < patterns; ++pattern) {
    double sum = 0;
    for (size_t i = 0; i < d.size(); ++i) sum += (pattern >> i) & 1 ? -d[i] : d[i];
    if (std::abs(sum) >= limit) ++hits;
  }
  return static_cast<double>(hits) / static_cast<double>(patterns);
}

double drawnPValue(std::span<const double> d, double limit, Random& random) {
  int hits = 0;
  for (int k = 0; k < kFlips; ++k) {
    double sum = 0;
    uint64_t bits = 0;
    for (size_t i = 0; i < d.size(); ++i) {
      if (i % 64 == 0) bits = random.bits();
      sum += (bits & 1) != 0 ? -d[i] : d[i];
      bits >>= 1;
    }
    if (std::abs(sum) >= limit) ++hits;
  }
  return (1.0 + hits) / (1.0 + kFlips);
}

}  // namespace

double quantile(std::span<const double> sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(at);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

SampleSummary summarize(std::span<const double> values, Random& random) {
  SampleSummary s;
  s.n = values.size();
  s.mean = s.n > 0 ? meanOf(values) : kNaN;
  s.ci_low = s.ci_high = s.mean;
  s.sd = kNaN;
  if (s.n < 2) return s;
  double squares = 0;
  for (const double v : values) squares += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(squares / static_cast<double>(s.n - 1));
  std::vector<double> means(kResamples);
  for (auto& mean : means) {
    double sum = 0;
    for (size_t i = 0; i < s.n; ++i) sum += values[random.below(s.n)];
    mean = sum / static_cast<double>(s.n);
  }
  std::sort(means.begin(), means.end());
  s.ci_low = quantile(means, 0.025);
  s.ci_high = quantile(means, 0.975);
  return s;
}

double signFlipPValue(std::span<const double> differences, Random& random) {
  if (differences.empty()) return kNaN;
  double sum = 0, size = 0;
  for (const double d : differences) {
    sum += d;
    size += std::abs(d);
  }
  // Patterns whose sums are equal but for rounding count as equally far.
  const double limit = std::abs(sum) - 1e-12 * size;
  return differences.size() <= kExactUpTo ? exactPValue(differences, limit) : drawnPValue(differences, limit, random);
}

}  // namespace sidestep
