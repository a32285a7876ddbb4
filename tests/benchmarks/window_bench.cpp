// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "planning/planners.h"
#include "support/encounter.h"
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

/// Section 4.1: 100 seeds of each scenario and pair. Counters: collisions, goals reached, mean of average velocity
/// and least clearance.
void BM_Section41(benchmark::State& state, const char* robot, const char* others) {
  constexpr int kSeeds = 100;
  for (auto _ : state) {
    double collisions = 0, reached = 0, velocity = 0, clearance = 0, least = 1e9;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const auto r = runEncounter(support::section41Encounter(static_cast<int>(state.range(0)), robot, others, seed));
      collisions += r.collided;
      reached += r.reached;
      velocity += r.average_velocity() / kSeeds;
      clearance += r.clearance_m / kSeeds;
      least = std::min(least, r.clearance_m);
    }
    state.counters["collisions"] = collisions;
    state.counters["reached"] = reached;
    state.counters["velocity"] = velocity;
    state.counters["clearance"] = clearance;
    state.counters["least"] = least;
  }
}
BENCHMARK_CAPTURE(BM_Section41, dwa_dwa, "dwa", "dwa")->DenseRange(1, 4)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(BM_Section41, edwa_dwa, "edwa", "dwa")->DenseRange(1, 4)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(BM_Section41, edwa_edwa, "edwa", "edwa")->DenseRange(1, 4)->Iterations(1)->Unit(benchmark::kSecond);
BENCHMARK_CAPTURE(BM_Section41, hrvo_dwa, "hrvo", "dwa")->DenseRange(1, 4)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace sidestep
