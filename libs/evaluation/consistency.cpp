// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/consistency.h"

#include <cmath>
#include <cstdio>

#include "localization/ekf.h"

namespace sidestep {

NisBand nisBand(uint64_t n, int dof, double gate_probability) {
  const double k = dof;
  double mean = k, square = k * (k + 2);
  if (gate_probability < 1) {
    const double q = chiSquareQuantile(gate_probability, dof);
    // F_k+2(q) = F_k(q) - (q/2)^(k/2) exp(-q/2) / Gamma(k/2 + 1)
    const auto next = [q](double F, double m) {
      return F - std::pow(q / 2, m / 2) * std::exp(-q / 2) / std::tgamma(m / 2 + 1);
    };
    const double F2 = next(gate_probability, k), F4 = next(F2, k + 2);
    mean = k * F2 / gate_probability;
    square = k * (k + 2) * F4 / gate_probability;
  }
  const double half = 1.959964 * std::sqrt((square - mean * mean) / static_cast<double>(n));
  return {mean, mean - half, mean + half};
}

Consistency judge(double mean_nis, uint64_t n, int dof, double gate_probability) {
  Consistency c{nisBand(n, dof, gate_probability), "consistent", 1};
  c.sd_factor = std::sqrt(mean_nis / c.band.expected);
  if (mean_nis > c.band.high) c.verdict = "over-confident";
  if (mean_nis < c.band.low) c.verdict = "too cautious";
  return c;
}

std::string consistencyLine(const std::string& label, double mean_nis, const Consistency& c) {
  char text[400];
  std::snprintf(text, sizeof text, "%s: %s: mean NIS %.3g, consistent is %.3g .. %.3g", label.c_str(),
                c.verdict.c_str(), mean_nis, c.band.low, c.band.high);
  std::string line = text;
  if (c.verdict == "consistent") return line;
  std::snprintf(text, sizeof text, "; its errors have about %.2g times the sd that the filter believes in",
                c.sd_factor);
  return line + text;
}

}  // namespace sidestep
