// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "planning/velocity/hrvo.h"
#include "support/antipodal_circle.h"

namespace sidestep {
namespace {

struct Crowd {
  std::vector<DiscView> discs;
  mrpt::math::TPoint2D own, preferred;
};

/// People of 0.3 m around the robot, none touching it, at up to 1 m/s; `spread_m` per root of their number.
Crowd randomCrowd(Random& random, int n, double spread_m) {
  Crowd crowd;
  const double reach = spread_m * std::sqrt(static_cast<double>(n));
  while (static_cast<int>(crowd.discs.size()) < n) {
    const mrpt::math::TPoint2D offset{random.uniform(-reach, reach), random.uniform(-reach, reach)};
    if (offset.norm() < 0.65) continue;
    const double a = random.uniform(-M_PI, M_PI), v = random.uniform();
    crowd.discs.push_back({offset, {v * std::cos(a), v * std::sin(a)}, 0.6, 0, 0.5});
  }
  const double a = random.uniform(-M_PI, M_PI);
  crowd.preferred = {std::cos(a), std::sin(a)};
  crowd.own = crowd.preferred * random.uniform(0.5, 1);
  return crowd;
}

/// One query: cones from discs and the nearest free velocity. `median_us` is over 1,000 random crowds, each timed over
/// 20 repetitions.
void BM_HrvoQuery(benchmark::State& state) {
  using Clock = std::chrono::steady_clock;
  HrvoParams params;
  params.neighbours = 1000;
  params.horizon_s = 1e6;
  Hrvo hrvo(params);
  Random random(1);
  std::vector<Crowd> crowds;
  for (int i = 0; i < 1000; ++i) crowds.push_back(randomCrowd(random, static_cast<int>(state.range(0)), 1.5));
  const auto query = [&](const Crowd& crowd) {
    hrvo.begin(crowd.own, 0.3, 0.25);
    for (const auto& d : crowd.discs) hrvo.disc(d);
    benchmark::DoNotOptimize(hrvo.solve(crowd.preferred, 1));
  };
  std::vector<double> us;
  for (auto _ : state) {
    us.clear();
    for (const auto& crowd : crowds) {
      const auto begin = Clock::now();
      for (int i = 0; i < 20; ++i) query(crowd);
      us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count() / 20);
    }
  }
  std::sort(us.begin(), us.end());
  state.counters["median_us"] = us[us.size() / 2];
  state.counters["p95_us"] = us[us.size() * 95 / 100];
  state.counters["max_us"] = us.back();
  state.SetItemsProcessed(state.iterations() * 20000);
}
BENCHMARK(BM_HrvoQuery)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

/// Antipodal circles until all have arrived.
void BM_AntipodalCircle(benchmark::State& state) {
  for (auto _ : state) {
    const auto r = support::antipodalCircle(static_cast<int>(state.range(0)), {});
    state.counters["colliding_pairs"] = r.colliding_pairs;
    state.counters["arrived"] = r.arrived;
    state.counters["time_s"] = r.time_s;
    state.counters["least_gap_m"] = r.least_gap_m;
    state.counters["us_per_query"] =
        benchmark::Counter(static_cast<double>(r.queries), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  }
}
BENCHMARK(BM_AntipodalCircle)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace sidestep
