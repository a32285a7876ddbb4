// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// One step of the particle filter beside one of MRPT's CParticleFilter::executeOn: the same motion model, likelihood,
// number of particles and resampling (systematic, in each step). ...AndEstimate: with mean and covariance on top of
// that.
#include <benchmark/benchmark.h>
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/bayes/CParticleFilterData.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/random/RandomGenerators.h>

#include "localization/filters/particle_filter.h"

namespace sidestep {
namespace {

MotionStep step() {
  MotionStep s;
  s.dt_s = 0.1;
  s.distance_m = 0.1;
  s.turn_rad = 0.02;
  s.distance_var = 1e-4;
  s.turn_var = 1e-4;
  return s;
}

/// What the robot is at after `i` steps, so that the measurement stays true to the motion.
mrpt::math::TPose2D truth(int64_t i) {
  mrpt::math::TPose2D p{0, 0, 0};
  for (int64_t k = 0; k < i % 314; ++k) p = moved(p, step());
  return p;
}

const std::vector<mrpt::math::TPose2D>& circle() {
  static const std::vector<mrpt::math::TPose2D> poses = [] {
    std::vector<mrpt::math::TPose2D> out;
    for (int64_t i = 0; i <= 314; ++i) out.push_back(truth(i));
    return out;
  }();
  return poses;
}

constexpr double kSdPosition = 0.2, kSdHeading = 0.2;

Measurement measurementAt(size_t i) {
  const auto& p = circle()[i % 314];
  Measurement m;
  m.kind = Measurement::Kind::kPositionHeading;
  m.time_s = static_cast<double>(i);
  m.z << p.x, p.y, p.phi;
  m.R.diagonal() << kSdPosition * kSdPosition, kSdPosition * kSdPosition, kSdHeading * kSdHeading;
  return m;
}

PoseBelief startBelief() {
  PoseBelief b;
  b.covariance.diagonal() << 0.01, 0.01, 0.01;
  return b;
}

void run(benchmark::State& state, const PfParams& params, bool with_estimate) {
  ParticleFilter filter(params, 1);
  filter.start(startBelief());
  size_t i = 0;
  for (auto _ : state) {
    if (++i % 314 == 0) filter.start(startBelief());
    filter.predict(step());
    benchmark::DoNotOptimize(filter.correct(measurementAt(i)));
    if (with_estimate) benchmark::DoNotOptimize(filter.estimate());
  }
  state.SetItemsProcessed(state.iterations() * params.particles);
}

PfParams asMrpt(const benchmark::State& state) {
  PfParams params;
  params.particles = static_cast<int>(state.range(0));
  params.resampling.each_step = true;
  params.resampling.roughening = 0;
  return params;
}

void BM_ParticleFilterStep(benchmark::State& state) { run(state, asMrpt(state), false); }
BENCHMARK(BM_ParticleFilterStep)->Arg(500)->Arg(5000)->Arg(20000)->Unit(benchmark::kMicrosecond);

void BM_ParticleFilterStepAndEstimate(benchmark::State& state) { run(state, asMrpt(state), true); }
BENCHMARK(BM_ParticleFilterStepAndEstimate)->Arg(500)->Arg(5000)->Arg(20000)->Unit(benchmark::kMicrosecond);

/// As users get it: default parameters, resampling where it is needed.
void BM_ParticleFilterStepAndEstimateDefault(benchmark::State& state) {
  PfParams params;
  params.particles = static_cast<int>(state.range(0));
  run(state, params, true);
}
BENCHMARK(BM_ParticleFilterStepAndEstimateDefault)->Arg(500)->Arg(20000)->Unit(benchmark::kMicrosecond);

// ---- MRPT ----

using MrptData = mrpt::bayes::CParticleFilterData<mrpt::math::TPose2D, mrpt::bayes::particle_storage_mode::VALUE>;

/// The same model on MRPT's framework, with its weights cured as its users must (they are not reset when resampling).
class MrptFilter : public MrptData, public mrpt::bayes::CParticleFilterDataImpl<MrptFilter, MrptData::CParticleList> {
 public:
  explicit MrptFilter(size_t n) : random_(1) {
    m_particles.resize(n);
    start();
  }
  void start() {
    for (auto& p : m_particles) {
      p.d = {random_.drawGaussian1D(0, 0.1), random_.drawGaussian1D(0, 0.1), random_.drawGaussian1D(0, 0.1)};
      p.log_w = 0;
    }
  }
  void prediction_and_update_pfStandardProposal(const mrpt::obs::CActionCollection*, const mrpt::obs::CSensoryFrame*,
                                                const mrpt::bayes::CParticleFilter::TParticleFilterOptions&) override {
    const MotionStep u = step();
    const double sd_d = std::sqrt(u.distance_var), sd_t = std::sqrt(u.turn_var);
    for (auto& p : m_particles) {
      MotionStep noisy = u;
      noisy.distance_m += sd_d * random_.drawGaussian1D_normalized();
      noisy.turn_rad += sd_t * random_.drawGaussian1D_normalized();
      p.d = moved(p.d, noisy);
      const double dx = (p.d.x - z.x) / kSdPosition, dy = (p.d.y - z.y) / kSdPosition;
      const double dyaw = mrpt::math::wrapToPi(p.d.phi - z.phi) / kSdHeading;
      p.log_w += -0.5 * (dx * dx + dy * dy + dyaw * dyaw);
    }
  }
  void performSubstitution(const std::vector<size_t>& index) override {
    mrpt::bayes::CParticleFilterDataImpl<MrptFilter, MrptData::CParticleList>::performSubstitution(index);
    for (auto& p : m_particles) p.log_w = 0;
  }
  mrpt::math::TPose2D z;

 private:
  mrpt::random::CRandomGenerator random_;
};

void BM_MrptParticleFilterStep(benchmark::State& state) {
  mrpt::bayes::CParticleFilter engine;
  engine.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
  engine.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
  engine.m_options.adaptiveSampleSize = false;
  engine.m_options.BETA = 1;  // in each step
  MrptFilter filter(static_cast<size_t>(state.range(0)));
  size_t i = 0;
  for (auto _ : state) {
    if (++i % 314 == 0) filter.start();
    filter.z = circle()[i % 314];
    engine.executeOn(filter, nullptr, nullptr);
    benchmark::DoNotOptimize(filter);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(BM_MrptParticleFilterStep)->Arg(500)->Arg(5000)->Arg(20000)->Unit(benchmark::kMicrosecond);

void BM_Gaussians(benchmark::State& state) {
  Random random(1);
  std::vector<double> out(1000);
  for (auto _ : state) {
    random.gaussians(out.data(), out.size());
    benchmark::DoNotOptimize(out.data());
  }
  state.SetItemsProcessed(state.iterations() * 1000);
}
BENCHMARK(BM_Gaussians);

}  // namespace
}  // namespace sidestep
