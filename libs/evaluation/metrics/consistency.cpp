// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/consistency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "localization/filters/ekf.h"

namespace sidestep {
namespace {

constexpr double kNormal95 = 1.959964;

/// F_m+2(q) from F = F_m(q): F_m+2(q) = F_m(q) - (q/2)^(m/2) exp(-q/2) / Gamma(m/2 + 1)
double nextCdf(double F, double q, double m) {
  return F - std::pow(q / 2, m / 2) * std::exp(-q / 2) / std::tgamma(m / 2 + 1);
}

/// E[x | x < q] of a chi-square of k degrees of freedom with F_k(q) = F.
double meanBelow(double q, double F, double k) { return k * nextCdf(F, q, k) / F; }

/// The mean of c^2 chi-square below the bound q.
double meanOfScaled(double c, double q, int dof) {
  const double scaled = q / (c * c);
  return c * c * meanBelow(scaled, chiSquareCdf(scaled, dof), dof);
}

double factorOf(double mean, int dof, double gate_probability) {
  if (gate_probability >= 1) return std::sqrt(mean / dof);
  const double q = chiSquareQuantile(gate_probability, dof);
  double low = 0, high = 20;  // far beyond it the density below the bound is flat: nothing tells them apart
  if (mean >= meanOfScaled(high, q, dof)) return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 60; ++i) {
    const double mid = 0.5 * (low + high);
    (meanOfScaled(mid, q, dof) < mean ? low : high) = mid;
  }
  return high;
}

Consistency judged(double mean, const ConsistencyBand& band, double factor) {
  Consistency c{band, "consistent", factor};
  if (mean > band.high) c.verdict = "over-confident";
  if (mean < band.low) c.verdict = "too cautious";
  return c;
}

}  // namespace

ConsistencyBand nisBand(double n, int dof, double gate_probability) {
  if (n < 30) return neesBand(std::max(1.0, n), dof);
  const double k = dof;
  double mean = k, square = k * (k + 2);
  if (gate_probability < 1) {
    const double q = chiSquareQuantile(gate_probability, dof);
    const double F2 = nextCdf(gate_probability, q, k), F4 = nextCdf(F2, q, k + 2);
    mean = meanBelow(q, gate_probability, k);
    square = k * (k + 2) * F4 / gate_probability;
  }
  const double half = kNormal95 * std::sqrt((square - mean * mean) / n);
  return {mean, mean - half, mean + half};
}

ConsistencyBand neesBand(double n_eff, int dof) {
  const double spread = 2 / (9 * n_eff * dof);
  const auto quantile = [&](double normal) {
    return dof * std::pow(std::max(0.0, 1 - spread + normal * std::sqrt(spread)), 3);
  };
  return {static_cast<double>(dof), quantile(-kNormal95), quantile(kNormal95)};
}

Consistency judgeNis(double mean_nis, double n, int dof, double gate_probability) {
  return judged(mean_nis, nisBand(n, dof, gate_probability), factorOf(mean_nis, dof, gate_probability));
}

Consistency judgeSensor(double mean_nis, double count, double n_eff, int dof, double gate_probability) {
  return judgeNis(mean_nis, n_eff, dof, n_eff < 0.999 * count ? 1 : gate_probability);
}

Consistency judgeNees(double mean_nees, double n_eff, int dof) {
  return judged(mean_nees, neesBand(n_eff, dof), std::sqrt(mean_nees / dof));
}

std::string consistencyLine(const std::string& label, const std::string& measure, double mean, const Consistency& c) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), "%s: %s: mean %s %.3g, consistent is %.3g .. %.3g", label.c_str(),
                c.verdict.c_str(), measure.c_str(), mean, c.band.low, c.band.high);
  std::string line = text.data();
  if (c.verdict == "consistent") return line;
  if (std::isfinite(c.sd_factor))
    std::snprintf(text.data(), text.size(), "; its errors have about %.2g times the sd that the filter believes in",
                  c.sd_factor);
  else
    std::snprintf(text.data(), text.size(), "; its errors are far beyond what the filter believes in");
  return line + text.data();
}

}  // namespace sidestep
