// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

namespace sidestep {

/// Where the mean NIS or NEES of a consistent filter lies.
struct ConsistencyBand {
  double expected = 0;       ///< without a gate the degrees of freedom
  double low = 0, high = 0;  ///< holds the mean with 95 %
};

/// NIS is chi-square with `dof` degrees of freedom, cut off where a gate lets the share `gate_probability` in (1: no
/// gate):
///   E[x | x < q] = k F_k+2(q) / F_k(q),  E[x^2 | x < q] = k (k + 2) F_k+4(q) / F_k(q),  F_k(q) = gate_probability
/// @param n    effective sample size of the accepted measurements, > 0; the interval is by the central limit theorem,
/// for
///             some tens of them; of fewer it is neesBand's
/// @param dof  1, 2 or 3
ConsistencyBand nisBand(double n, int dof, double gate_probability);

/// The mean of n_eff independent NEES of `dof` degrees of freedom is chi-square with n_eff * dof of them, by n_eff; its
/// quantiles by Wilson and Hilferty (1931).
/// @param n_eff  NormalizedErrors::effectiveCount, >= 1
ConsistencyBand neesBand(double n_eff, int dof);

/// What a mean NIS or NEES says of the noise that a filter believes in.
struct Consistency {
  ConsistencyBand band;
  std::string verdict;   ///< "consistent", "over-confident" (above the band), "too cautious" (below)
  double sd_factor = 1;  ///< real sd of the innovations (errors) over the believed one
};

/// The factor is the c for which errors of c times the sd, cut off by the same gate, have that mean; infinite if none
/// is that large.
Consistency judgeNis(double mean_nis, double n, int dof, double gate_probability);
Consistency judgeNees(double mean_nees, double n_eff, int dof);

/// The same for a sensor of which `count` measurements were accepted, with effective sample size `n_eff`. Where errors
/// are correlated the gate, which is by the inflated variance, takes nothing away.
Consistency judgeSensor(double mean_nis, double count, double n_eff, int dof, double gate_probability);

/// One line for the user. @param label  what is judged; @param measure  "NIS" or "NEES"
std::string consistencyLine(const std::string& label, const std::string& measure, double mean, const Consistency& c);

}  // namespace sidestep
