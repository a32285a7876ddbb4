// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <bit>
#include <cmath>
#include <cstdint>

namespace sidestep {

// Functions without branches for loops over thousands of particles. `T` is double or a fixed array of them.

/// Two neighbours in an array: what one register of any x86-64 holds.
using Pair = Eigen::Array<double, 2, 1>;

/// The integer nearest to `a`, for |a| < 2^51, by additions only.
template <typename T>
inline T nearestInteger(const T& a) {
  constexpr double kMagic = 6755399441055744.0;  // 1.5 * 2^52: beyond it doubles are integers
  const T shifted = a + kMagic;
  return shifted - kMagic;
}

/// `a` by whole turns into [-pi, pi], for |a| < 1e6 rad within 1e-9.
template <typename T>
inline T wrapAngle(const T& a) {
  return a - 2 * M_PI * nearestInteger<T>(a * (0.5 / M_PI));
}

/// Sine and cosine within 1e-9 for |a| < 1e3: half turns off, then Taylor's series on [-pi/2, pi/2].
template <typename T>
inline void sineCosine(const T& a, T& sine, T& cosine) {
  const T n = nearestInteger<T>(a * (1 / M_PI)), r = a - n * M_PI, q = r * r;
  const T sign = 1 - 2 * (n - 2 * nearestInteger<T>(0.5 * n - 0.25));
  T s = q * 1.6059043836821613e-10 - 2.5052108385441720e-8;  // 1 / 13!, 1 / 11!
  s = s * q + 2.7557319223985893e-6;
  s = s * q - 1.9841269841269841e-4;
  s = s * q + 8.3333333333333333e-3;
  s = s * q - 1.6666666666666667e-1;
  s = s * q + 1;
  T c = q * -1.1470745597729725e-11 + 2.0876756987868100e-9;  // 1 / 14!, 1 / 12!
  c = c * q - 2.7557319223985888e-7;
  c = c * q + 2.4801587301587302e-5;
  c = c * q - 1.3888888888888889e-3;
  c = c * q + 4.1666666666666667e-2;
  c = c * q - 5e-1;
  c = c * q + 1;
  sine = sign * s * r;
  cosine = sign * c;
}

/// e^a within 1e-9 of its size for a <= 0, which is what a weight needs; e^-700 for less.
inline double weightExp(double a) {
  constexpr double kMagic = 6755399441055744.0;
  a = a < -700 ? -700 : a;
  const double shifted = a * M_LOG2E + kMagic, n = shifted - kMagic, r = a - n * M_LN2;
  double p = r * (1.0 / 40320) + 1.0 / 5040;
  p = p * r + 1.0 / 720;
  p = p * r + 1.0 / 120;
  p = p * r + 1.0 / 24;
  p = p * r + 1.0 / 6;
  p = p * r + 0.5;
  p = p * r + 1;
  p = p * r + 1;
  // The low bits of `shifted` are the integer n: moved up, they are added to the exponent.
  return std::bit_cast<double>(std::bit_cast<int64_t>(p) +
                               static_cast<int64_t>(std::bit_cast<uint64_t>(shifted) << 52));
}

/// Calls f(i, a Pair) for i = 0, 2, ... and, if `n` is odd, f(n - 1, double()) for the last one.
template <typename F>
inline void forPairs(Eigen::Index n, const F& f) {
  Eigen::Index i = 0;
  for (; i + 2 <= n; i += 2) f(i, Pair(Pair::Zero()));
  if (i < n) f(i, double());
}
inline Pair at(const double* a, Eigen::Index i, Pair) { return Eigen::Map<const Pair>(a + i); }
inline double at(const double* a, Eigen::Index i, double) { return a[i]; }

/// A sum over pairs.
struct PairSum {
  Pair value = Pair::Zero();
  void add(const Pair& v) { value += v; }
  void add(double v) { value(0) += v; }
  double total() const { return value(0) + value(1); }
};

}  // namespace sidestep
