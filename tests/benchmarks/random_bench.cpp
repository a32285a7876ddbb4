// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Random numbers of our own beside Boost.Random's, which gives the same bytes on every machine too.
#include <benchmark/benchmark.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>
#include <vector>

#include "core/random.h"

namespace sidestep {
namespace {

constexpr size_t kNumbers = 4096;

/// Our generator as Boost.Random wants one.
struct OurEngine {
  using result_type = uint64_t;
  Random random{1};
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }
  result_type operator()() { return random.bits(); }
};

template <class Next>
void draw(benchmark::State& state, Next next) {
  std::vector<double> out(kNumbers);
  for (auto _ : state) {
    for (auto& x : out) x = next();
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * kNumbers));
}

void gaussianOurs(benchmark::State& state) {
  Random random(1);
  draw(state, [&] { return random.gaussian(); });
}
BENCHMARK(gaussianOurs);

void gaussiansOurs(benchmark::State& state) {
  Random random(1);
  std::vector<double> out(kNumbers);
  for (auto _ : state) {
    random.gaussians(out.data(), out.size());
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * kNumbers));
}
BENCHMARK(gaussiansOurs);

void gaussianBoostOverOurGenerator(benchmark::State& state) {
  OurEngine engine;
  boost::random::normal_distribution<double> normal;
  draw(state, [&] { return normal(engine); });
}
BENCHMARK(gaussianBoostOverOurGenerator);

void gaussianBoost(benchmark::State& state) {
  boost::random::mt19937_64 engine(1);
  boost::random::normal_distribution<double> normal;
  draw(state, [&] { return normal(engine); });
}
BENCHMARK(gaussianBoost);

void uniformOurs(benchmark::State& state) {
  Random random(1);
  draw(state, [&] { return random.uniform(); });
}
BENCHMARK(uniformOurs);

void uniformBoost(benchmark::State& state) {
  boost::random::mt19937_64 engine(1);
  boost::random::uniform_01<double> uniform;
  draw(state, [&] { return uniform(engine); });
}
BENCHMARK(uniformBoost);

void startOurs(benchmark::State& state) {
  uint64_t stream = 0;
  for (auto _ : state) {
    Random random(1, stream++);
    benchmark::DoNotOptimize(random.bits());
  }
}
BENCHMARK(startOurs);

void startBoost(benchmark::State& state) {
  uint64_t seed = 0;
  for (auto _ : state) {
    boost::random::mt19937_64 engine(seed++);
    benchmark::DoNotOptimize(engine());
  }
}
BENCHMARK(startBoost);

}  // namespace
}  // namespace sidestep
