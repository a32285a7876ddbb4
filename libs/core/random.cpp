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

namespace {

/// The layer that the bits name, and the number they stand for in it: 54 bits with sign, in [-1, 1) times its width.
struct Candidate {
  size_t layer;
  double u, x;
  explicit Candidate(uint64_t b)
      : layer(b & (kLayers - 1)),
        u(static_cast<double>(static_cast<int64_t>(b) >> 10) * 0x1p-53),
        x(u * kZiggurat.x[layer]) {}
  bool inside() const { return std::abs(x) < kZiggurat.x[layer + 1]; }
};

/// What follows where the first candidate is not surely under the curve: one time in a hundred.
double atTheEdge(Random& random, Candidate c) {
  for (;;) {
    if (c.inside()) return c.x;
    if (c.layer == 0) {
      for (;;) {  // the tail, Marsaglia 1964
        const double a = -std::log(1 - random.uniform()) / kTail, b = -std::log(1 - random.uniform());
        if (b + b > a * a) return c.u < 0 ? -(kTail + a) : kTail + a;
      }
    }
    const double low = kZiggurat.f[c.layer], high = kZiggurat.f[c.layer + 1];
    if (low + random.uniform() * (high - low) < std::exp(-0.5 * c.x * c.x)) return c.x;
    c = Candidate(random.bits());
  }
}

}  // namespace

double Random::gaussian() {
  const Candidate c(bits());
  return c.inside() ? c.x : atTheEdge(*this, c);
}

void Random::gaussians(double* out, size_t n) {
  Random local = *this;  // of which no address is taken, so that it stays in registers
  for (size_t i = 0; i < n; ++i) {
    const Candidate c(local.bits());
    out[i] = c.x;
    if (c.inside()) [[likely]]
      continue;
    Random away = local;
    out[i] = atTheEdge(away, c);
    local = away;
  }
  *this = local;
}

}  // namespace sidestep
