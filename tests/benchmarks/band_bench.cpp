// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Times of a plan of the band planners: points or walkers between (0, 0) and (8, 0), twenty scenes in turn.
#include <benchmark/benchmark.h>

#include <memory>

#include "support/band_scenes.h"

namespace sidestep {
namespace {

constexpr int kScenes = 20;

struct Case {
  support::BandScene scene;
  std::unique_ptr<BandPlanner> planner;
};

/// @param moving  the obstacles move and are seen in time
std::vector<Case> cases(int obstacles, int classes, bool moving) {
  BandPlannerParams params = bandPlannerParams(moving ? "eteb" : "teb");
  params.exploration.classes_max = classes;
  std::vector<Case> out;
  for (uint64_t seed = 1; seed <= kScenes; ++seed)
    out.push_back({{seed, moving ? 0 : obstacles, moving ? obstacles : 0}, std::make_unique<BandPlanner>(params)});
  return out;
}

/// A plan from scratch.
void BM_Cold(benchmark::State& state, bool moving) {
  auto all = cases(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), moving);
  PlanOutput out;
  size_t i = 0;
  for (auto _ : state) {
    Case& c = all[i++ % all.size()];
    c.planner->reset();
    c.planner->plan(c.scene.input(), out);
    benchmark::DoNotOptimize(out.command);
  }
}

/// Plan after plan while the robot drives what was ordered, starting anew after 50.
void BM_Warm(benchmark::State& state, bool moving) {
  constexpr int kReplans = 50;
  const auto fresh = [&] { return cases(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)), moving); };
  auto all = fresh();
  PlanOutput out;
  int n = 0;
  for (auto _ : state) {
    if (n % kReplans == 0) {
      state.PauseTiming();
      if (n % (kReplans * kScenes) == 0) all = fresh();
      Case& first = all[static_cast<size_t>(n / kReplans % kScenes)];
      first.planner->plan(first.scene.input(), out);
      first.scene.advance(out.command);
      state.ResumeTiming();
    }
    Case& c = all[static_cast<size_t>(n++ / kReplans % kScenes)];
    c.planner->plan(c.scene.input(), out);
    c.scene.advance(out.command);
  }
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"obstacles", "classes"})->Unit(benchmark::kMicrosecond);
  for (const int classes : {1, 4})
    for (const int obstacles : {5, 20, 50, 200, 800}) b->Args({obstacles, classes});
}
BENCHMARK_CAPTURE(BM_Cold, static, false)->Apply(sizes);
BENCHMARK_CAPTURE(BM_Warm, static, false)->Apply(sizes);
BENCHMARK_CAPTURE(BM_Cold, moving, true)->Apply(sizes);
BENCHMARK_CAPTURE(BM_Warm, moving, true)->Apply(sizes);

}  // namespace
}  // namespace sidestep
