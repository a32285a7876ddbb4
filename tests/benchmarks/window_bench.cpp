// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "planning/planners.h"
#include "support/planning_worlds.h"

namespace sidestep {
namespace {

/// One cycle among 50 people within 5 m of the robot, 11 x 21 velocities, 3 s; 100 worlds in turn.
void BM_Cycle(benchmark::State& state, const char* name) {
  Random random(1);
  std::vector<support::PlanningWorld> worlds;
  for (int i = 0; i < 100; ++i) worlds.push_back(support::crowdedWorld(random, static_cast<int>(state.range(0))));
  const auto planner = makeLocalPlanner(name);
  PlanOutput out;
  size_t i = 0;
  for (auto _ : state) {
    planner->plan(worlds[i].shown(), out);
    benchmark::DoNotOptimize(out.command);
    i = (i + 1) % worlds.size();
  }
}
BENCHMARK_CAPTURE(BM_Cycle, dwa, "dwa")->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Cycle, edwa, "edwa")->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(BM_Cycle, hrvo, "hrvo")->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sidestep
