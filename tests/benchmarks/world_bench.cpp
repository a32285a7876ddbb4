// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What a simulated second costs. Target: 20 people, 20 Hz control, a laser of 360 beams: at least 100 x real time on
// one core; linear up to 1,000 people at one density.
#include <benchmark/benchmark.h>

#include <cmath>

#include "evaluation/experiments/world_controllers.h"
#include "simulation/localization_scenario.h"
#include "simulation/world.h"

namespace sidestep {
namespace {

/// People criss-cross a walled square in which there are 0.05 of them on a square metre.
WorldParams square(int people, int beams, double step_s) {
  WorldParams p;
  const double half = 0.5 * std::sqrt(people / 0.05);
  p.step_s = step_s;
  p.duration_s = 1e5;
  p.wall_names = {"around"};
  p.walls["around"] = {{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, true};
  p.robot_names = {"robot"};
  RobotParams robot;
  robot.x_m = -half + 1;
  robot.goal_x_m = 1e4;  // never there: into the wall and on
  robot.planner = "straight";
  p.robots["robot"] = robot;
  p.people_names = {"crowd"};
  PeopleParams crowd;
  crowd.count = people;
  crowd.start_spread_m = crowd.goal_spread_m = half - 1;
  crowd.then = "return";
  p.people["crowd"] = crowd;
  p.laser.rate_hz = beams > 0 ? 20 : 0;
  p.laser.beams = std::max(beams, 2);
  p.laser.field = 2 * M_PI;
  p.laser.range_m = 25;
  return p;
}

/// Seconds simulated per second.
void BM_World(benchmark::State& state) {
  World world(square(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                     0.001 * static_cast<double>(state.range(2))),
              1, {}, navigatorControllers());
  for (int i = 0; i < 500; ++i) world.step();
  const double begin = world.time();
  for (auto _ : state) world.step();
  state.counters["x_real_time"] = benchmark::Counter(world.time() - begin, benchmark::Counter::kIsRate);
}
BENCHMARK(BM_World)
    ->ArgNames({"people", "beams", "step_ms"})
    ->Args({20, 360, 10})
    ->Args({20, 360, 50})
    ->Args({20, 1081, 10})
    ->Args({20, 0, 10})
    ->Args({10, 0, 10})
    ->Args({100, 0, 10})
    ->Args({300, 0, 10})
    ->Args({1000, 0, 10})
    ->Args({1000, 360, 10});

void BM_LaserCast(benchmark::State& state) {
  LaserParams p;
  p.beams = static_cast<int>(state.range(0));
  p.field = 2 * M_PI;
  p.range_m = 25;
  LaserScanner laser(p);
  std::vector<Segment> walls;
  for (int i = 0; i < state.range(1); ++i) {
    const double a = 0.7 * i, d = 3 + 0.02 * i;
    walls.push_back({{d * std::cos(a), d * std::sin(a)}, {d * std::cos(a) + 1, d * std::sin(a) + 0.5}});
  }
  const WallIndex index(walls);
  std::vector<SeenDisc> legs;
  for (int i = 0; i < 40; ++i) legs.push_back({{2 + 0.1 * i, 3 * std::sin(i)}, 0.07});
  for (auto _ : state) benchmark::DoNotOptimize(laser.cast({0, 0, 0.3}, index, legs).data());
}
BENCHMARK(BM_LaserCast)
    ->ArgNames({"beams", "walls"})
    ->Args({360, 4})
    ->Args({360, 100})
    ->Args({1081, 100})
    ->Args({1081, 1000});

/// One run of the circle, 6300 steps, as a study does 1200 of.
void BM_LocalizationRun(benchmark::State& state) {
  LocalizationScenarioParams p;
  p.gps.rate_hz = 100;
  const LocalizationScenario scenario(p);
  uint64_t seed = 0;
  double sum = 0;
  for (auto _ : state) {
    auto stream = scenario.run(seed++);
    for (SensorStep step; stream.next(step);) sum += step.odometry.turn_rad;
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(BM_LocalizationRun)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sidestep
