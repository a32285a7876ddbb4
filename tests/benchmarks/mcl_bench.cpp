// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// A whole step of Monte Carlo localization on the map of MRPT's demo, beside what MRPT's filter does in such a step for
// the likelihoods alone: the same map, number of particles and beams (361 by 6 = 60), one core. Needs mrpt-common.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "localization/filters/mcl.h"
#include "maps/map_file.h"

namespace sidestep {
namespace {

const GridMap& demoMap() {
  static const GridMap map = [] {
    MapReadParams params;
    params.simplemap_resolution_m = 0.06;
    return readMap("/usr/share/mrpt/datasets/localization_demo.simplemap.gz", params);
  }();
  return map;
}

const mrpt::math::TPose2D kPose{15.89, -10.0, 0.084};

/// What the laser of the demo (361 beams, half a turn) sees from near where its log ends.
mrpt::obs::CObservation2DRangeScan demoScan() {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = static_cast<float>(M_PI);
  scan.maxRange = 80;
  scan.rightToLeft = true;
  demoMap().grid->laserScanSimulator(scan, mrpt::poses::CPose2D(kPose), 0.6f, 361);
  return scan;
}

void BM_MclStep(benchmark::State& state) {
  MclParams params;
  params.engine.particles = static_cast<int>(state.range(0));
  params.engine.resampling.kld = false;
  params.recovery_share = 0;
  Mcl mcl(params, 1, std::make_shared<ScanModel>(demoMap(), params.scan), false);
  PoseBelief belief;
  belief.mean = kPose;
  belief.covariance.diagonal() << 0.25, 0.25, 0.04;
  mcl.start(belief);
  Measurement m;
  m.kind = Measurement::Kind::kScan;
  m.scan = readScan(ScanParams(), demoScan());
  MotionStep step;
  step.dt_s = 0.1;
  step.distance_m = 0.06;
  step.distance_var = step.turn_var = 1e-4;
  for (auto _ : state) {
    mcl.predict(step);
    step.distance_m = -step.distance_m;  // to and fro, so that the scan stays true
    m.time_s += step.dt_s;               // rivals are looked for now and then
    benchmark::DoNotOptimize(mcl.correct(m));
    benchmark::DoNotOptimize(mcl.estimate());
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_MclStep)->Arg(500)->Arg(10000)->Unit(benchmark::kMicrosecond);

void BM_MrptLikelihoodsOfAStep(benchmark::State& state) {
  auto& grid = *demoMap().grid;
  auto& options = grid.likelihoodOptions;
  options.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  options.LF_decimation = 6;
  options.LF_stdHit = 0.2f;
  options.LF_maxCorrsDistance = 0.3f;
  options.LF_maxRange = 80;
  options.enableLikelihoodCache = true;
  const auto scan = demoScan();
  Random random(1);
  for (auto _ : state) {
    double sum = 0;
    for (int64_t i = 0; i < state.range(0); ++i)
      sum += grid.computeObservationLikelihood(
          scan, mrpt::poses::CPose3D(random.gaussian(kPose.x, 0.1), random.gaussian(kPose.y, 0.1), 0,
                                     random.gaussian(kPose.phi, 0.05), 0, 0));
    benchmark::DoNotOptimize(sum);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_MrptLikelihoodsOfAStep)->Arg(500)->Arg(10000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sidestep
