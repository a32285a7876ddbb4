// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "localization/filters/ekf.h"
#include "localization/localizer.h"
#include "support/readings.h"

namespace sidestep {
namespace {

/// One prediction and one position fix.
template <int N>
void BM_EkfPredictCorrect(benchmark::State& state) {
  EkfParams params;
  params.heading_offset_sd = N > 3 ? 0.01 : 0;
  params.yaw_rate_bias_sd = params.wheel_scale_sd = N > 4 ? 0.01 : 0;
  Ekf<N> ekf(params);
  PoseBelief belief;
  belief.covariance.diagonal() << 1, 1, 0.1;
  ekf.start(belief);
  MotionStep step;
  step.dt_s = 0.1;
  step.distance_m = 0.1;
  step.turn_rad = 0.02;
  step.distance_var = step.turn_var = 1e-4;
  step.turn_from_gyro = true;
  Measurement fix;
  fix.R(0, 0) = fix.R(1, 1) = 9;
  for (auto _ : state) {
    ekf.predict(step);
    const auto now = ekf.estimate().mean;
    fix.z << now.x, now.y, 0;
    benchmark::DoNotOptimize(ekf.correct(fix));
  }
}
BENCHMARK(BM_EkfPredictCorrect<3>);
BENCHMARK(BM_EkfPredictCorrect<4>);
BENCHMARK(BM_EkfPredictCorrect<8>);

/// 100 s of odometry at 20 Hz with fixes at 5 Hz; items are odometry readings.
void BM_LocalizerOdometryGps(benchmark::State& state) {
  constexpr int kReadings = 2000;
  std::vector<Reading> log;
  for (int i = 0; i < kReadings; ++i) {
    log.push_back(support::wheelsAt(support::kStart_s + 0.05 * i, support::onCircle(1, 0.1, 0.05 * i)));
    if (i % 4 != 2) continue;
    const auto truth = support::onCircle(1, 0.1, 0.05 * i + 0.01);
    log.push_back(support::positionAt(support::kStart_s + 0.05 * i + 0.01, truth.x, truth.y));
  }
  LocalizerParams params;
  params.start.pose_given = true;
  Expectation expect;
  expect.positions = true;
  for (auto _ : state) {
    Localizer localizer(params, makeEkf({}), {expect, {}, false});
    for (const auto& reading : log) {
      localizer.observe(reading);
      benchmark::DoNotOptimize(localizer.takeEstimates());
    }
  }
  state.SetItemsProcessed(state.iterations() * kReadings);
}
BENCHMARK(BM_LocalizerOdometryGps)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sidestep
