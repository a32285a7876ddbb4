// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Speed of distance field, planning grid and planners on MRPT's Malaga campus map with 0.3 m of clearance, from a
// corner of its largest component to the far one. `sidestep-plan path --pairs` measures many queries.
#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/imgproc.hpp>

#include "maps/map_file.h"
#include "planning/global/any_angle_planner.h"

namespace {

using namespace sidestep;
using mrpt::math::TPose2D;

const GridMap& campus() {
  static const GridMap map = readMap("/usr/share/mrpt/datasets/2006-MalagaCampus.gridmap.gz");
  return map;
}

std::shared_ptr<const DistanceField> field() {
  static const auto field = std::make_shared<const DistanceField>(distanceField(campus()));
  return field;
}

std::shared_ptr<const PlanningGrid> grid() {
  static const auto grid = std::make_shared<const PlanningGrid>(field(), 0.3);
  return grid;
}

/// Cells of the largest component at two fifths and four fifths of its numbering: some 100 m apart.
std::pair<TPose2D, TPose2D> query() {
  std::map<int32_t, std::vector<uint32_t>> components;
  for (uint32_t cell = 0; cell < grid()->size(); ++cell)
    if (grid()->isFree(cell)) components[grid()->component(cell)].push_back(cell);
  const std::vector<uint32_t>* largest = nullptr;
  for (const auto& [number, cells] : components)
    if (largest == nullptr || cells.size() > largest->size()) largest = &cells;
  const auto a = grid()->centre((*largest)[largest->size() * 2 / 5]),
             b = grid()->centre((*largest)[largest->size() * 4 / 5]);
  return {{a.x, a.y, 0}, {b.x, b.y, 0}};
}

void transformAlone(benchmark::State& state) {
  const auto frame = campus().frame();
  auto blocked = blockedCells(campus());
  cv::Mat free = cv::Mat(frame.height, frame.width, CV_8U, blocked.data()) == 0, out;
  for (auto _ : state) cv::distanceTransform(free, out, cv::DIST_L2, cv::DIST_MASK_PRECISE);
}
BENCHMARK(transformAlone)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void buildField(benchmark::State& state) {
  const auto frame = campus().frame();
  const auto blocked = blockedCells(campus());
  for (auto _ : state) benchmark::DoNotOptimize(DistanceField(frame, blocked));
}
BENCHMARK(buildField)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void updateField(benchmark::State& state) {
  DistanceField changing = *field();
  const auto goal = query().second;
  const auto place = changing.frame().T_map_grid.inverseComposePoint(mrpt::math::TPoint2D(goal.x, goal.y));
  const int ix = static_cast<int>(place.x / 0.08), iy = static_cast<int>(place.y / 0.08);
  const std::vector<uint8_t> none(100, 0), all(100, 1);
  for (auto _ : state) {
    changing.update({ix, iy, ix + 9, iy + 9}, all);
    state.PauseTiming();
    changing.update({ix, iy, ix + 9, iy + 9}, none);
    state.ResumeTiming();
  }
}
BENCHMARK(updateField)->Iterations(100)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void queryField(benchmark::State& state) {
  mrpt::math::TPoint2D gradient;
  double x = 20, sum = 0;
  for (auto _ : state) {
    x = x > 100 ? 20 : x + 0.013;
    sum += field()->clearance(x, 0.3 * x, gradient);
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(queryField);

void buildGrid(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(PlanningGrid(field(), 0.3));
}
BENCHMARK(buildGrid)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

template <typename Planner, typename... Arguments>
void planWith(benchmark::State& state, Arguments... arguments) {
  Planner planner(grid(), GridSearchParams{}, arguments...);
  const auto [start, goal] = query();
  double length = 0;
  for (auto _ : state) length = pathLength(planner.plan(start, goal).poses);
  state.counters["length_m"] = length;
}
void astar(benchmark::State& state) { planWith<GridPlanner>(state, true); }
void dijkstra(benchmark::State& state) { planWith<GridPlanner>(state, false); }
void anyAngle(benchmark::State& state) { planWith<AnyAnglePlanner>(state); }
BENCHMARK(astar)->Unit(benchmark::kMillisecond);
BENCHMARK(dijkstra)->Unit(benchmark::kMillisecond);
BENCHMARK(anyAngle)->Unit(benchmark::kMillisecond);

}  // namespace
