// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

namespace sidestep {

/// Where the mean NIS of a consistent filter lies.
struct NisBand {
  double expected = 0;       ///< without a gate the degrees of freedom
  double low = 0, high = 0;  ///< holds the mean of n measurements with 95 %
};

/// NIS is chi-square with `dof` degrees of freedom, cut off where a gate lets the share `gate_probability` in (1: no
/// gate):
///   E[x | x < q] = k F_k+2(q) / F_k(q),  E[x^2 | x < q] = k (k + 2) F_k+4(q) / F_k(q),  F_k(q) = gate_probability
/// @param n    accepted measurements, > 0; the band is by the central limit theorem, for some tens of them
/// @param dof  1, 2 or 3
NisBand nisBand(uint64_t n, int dof, double gate_probability);

/// What a mean NIS says of the noise that a filter believes in.
struct Consistency {
  NisBand band;
  std::string verdict;   ///< "consistent", "over-confident" (above the band), "too cautious" (below)
  double sd_factor = 1;  ///< real sd of the innovations over the believed one
};

Consistency judge(double mean_nis, uint64_t n, int dof, double gate_probability);

/// One line for the user, with the name of the sensor.
std::string consistencyLine(const std::string& label, double mean_nis, const Consistency& c);

}  // namespace sidestep
