// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sidestep {

/// Seeded random numbers: xoshiro256++ (Blackman & Vigna 2019), filled by splitmix64; Gaussians by the ziggurat
/// (Marsaglia & Tsang 2000). The same seed and stream give the same numbers on every run and for any number of threads,
/// as long as each task has its own `Random`. Not for secrets.
class Random {
 public:
  /// @param seed    the user's
  /// @param stream  which of the independent sequences of that seed: a run's place in its matrix, a sensor's number
  explicit Random(uint64_t seed, uint64_t stream = 0);

  uint64_t bits() {
    const uint64_t result = std::rotl(s_[0] + s_[3], 23) + s_[0], t = s_[1] << 17;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= t;
    s_[3] = std::rotl(s_[3], 45);
    return result;
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In 0 .. n - 1; n > 0. The bias is below n / 2^53.
  uint64_t below(uint64_t n) { return static_cast<uint64_t>(uniform() * static_cast<double>(n)); }
  /// Mean 0, sd 1.
  double gaussian();
  double gaussian(double mean, double sd) { return mean + sd * gaussian(); }
  /// The next `n` of gaussian() into `out`, the same numbers, in a third of the time.
  void gaussians(double* out, size_t n);

  /// Where in its sequence the generator is; `setState` goes on from there.
  std::array<uint64_t, 4> state() const { return {s_[0], s_[1], s_[2], s_[3]}; }
  void setState(const std::array<uint64_t, 4>& state) { std::copy(state.begin(), state.end(), s_); }

 private:
  uint64_t s_[4];
};

}  // namespace sidestep
