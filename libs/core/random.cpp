// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.h"

#include <array>
#include <cmath>

namespace sidestep {
namespace {

uint64_t splitmix(uint64_t& x) {
  uint64_t z = (x += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

/// 256 layers of equal area under exp(-x^2 / 2), the lowest with the tail beyond `kTail`.
constexpr int kLayers = 256;
constexpr double kTail = 3.6541528853610088, kArea = 0.00492867323399;

struct Ziggurat {
  std::array<double, kLayers + 1> x, f;
  Ziggurat() {
    f[0] = std::exp(-0.5 * kTail * kTail);
    x[0] = kArea / f[0];
    x[1] = kTail;
    for (int i = 2; i < kLayers; ++i) {
      const double previous = x[i - 1];
      x[i] = std::sqrt(-2 * std::log(kArea / previous + std::exp(-0.5 * previous * previous)));
    }
    x[kLayers] = 0;
    for (int i = 1; i <= kLayers; ++i) f[i] = std::exp(-0.5 * x[i] * x[i]);
  }
};

const Ziggurat kZiggurat;

}  // namespace

Random::Random(uint64_t seed, uint64_t stream) {
  uint64_t x = seed;
  x = splitmix(x) + stream;
  for (auto& s : s_) s = splitmix(x);
}

double Random::gaussian() {
  for (;;) {
    const uint64_t b = bits();
    const auto i = static_cast<size_t>(b & (kLayers - 1));
    // 54 bits with sign: in [-1, 1)
    const double u = static_cast<double>(static_cast<int64_t>(b) >> 10) * 0x1p-53;
    const double x = u * kZiggurat.x[i];
    if (std::abs(x) < kZiggurat.x[i + 1]) return x;
    if (i == 0) {
      for (;;) {  // the tail, Marsaglia 1964
        const double a = -std::log(1 - uniform()) / kTail, b2 = -std::log(1 - uniform());
        if (b2 + b2 > a * a) return u < 0 ? -(kTail + a) : kTail + a;
      }
    }
    if (kZiggurat.f[i] + uniform() * (kZiggurat.f[i + 1] - kZiggurat.f[i]) < std::exp(-0.5 * x * x)) return x;
  }
}

}  // namespace sidestep
