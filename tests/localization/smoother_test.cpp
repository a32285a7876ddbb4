// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/errors.h"
#include "localization/filters/ekf.h"
#include "localization/filters/particle_filter.h"
#include "localization/localizer.h"
#include "support/measurements.h"
#include "support/readings.h"

namespace sidestep {
namespace {

using support::saved;

MotionStep ahead(double distance_m, double distance_var, double turn_rad = 0, double turn_var = 0) {
  MotionStep step;
  step.dt_s = 1;
  step.distance_m = distance_m;
  step.distance_var = distance_var;
  step.turn_rad = turn_rad;
  step.turn_var = turn_var;
  return step;
}

Measurement fix(double x, double y, double sd) {
  Measurement m;
  m.kind = Measurement::Kind::kPosition;
  m.z << x, y, 0;
  m.R(0, 0) = m.R(1, 1) = sd * sd;
  return m;
}

EkfParams plain() {
  EkfParams p;
  p.heading_offset_sd = 0;
  p.gate = false;
  return p;
}

TEST(Smoother, IsTheRegressionOfTheStartOnAFixAtTheEnd) {
  // x0 ~ N(0, 4); x1 = x0 + 1 + noise of variance 1; z = x1 + noise of variance 1, z = 4. With s = 4 + 1 + 1:
  // E[x0 | z] = 0 + 4 / s (4 - 1) = 2, var = 4 - 16 / s = 4 / 3; E[x1 | z] = 1 + 5 / s * 3 = 3.5, var = 5 - 25 / s = 5
  // / 6.
  Ekf<3> ekf(plain());
  PoseBelief start;
  start.covariance.diagonal() << 4, 1, 0;  // the yaw is known: its row of zeros must not spoil the others
  ekf.start(start);
  Smoother smoother;
  smoother.start(0, saved(ekf));
  ekf.predict(ahead(1, 1));
  smoother.motion(1, ahead(1, 1), saved(ekf));
  ekf.correct(fix(4, 0, 1));
  smoother.correction(1, 1, saved(ekf));
  const auto b = smoother.beliefs(ekf, {0, 1});
  EXPECT_NEAR(b[0].mean.x, 2, 1e-9);
  EXPECT_NEAR(b[0].covariance(0, 0), 4.0 / 3, 1e-9);
  EXPECT_NEAR(b[1].mean.x, 3.5, 1e-9);
  EXPECT_NEAR(b[1].covariance(0, 0), 5.0 / 6, 1e-9);
}

TEST(Smoother, TakesAResetAsAJumpOfTheState) {
  // x0 ~ N(0, 1), opened 9 times, then z = 10 of variance 1: x1 ~ N(9, 0.9); back through the jump: 0 + (9 - 0) / 9
  // = 1.
  EkfParams params;
  params.heading_offset_sd = 0;
  params.gate_patience_s = 0;
  Ekf<3> ekf(params);
  PoseBelief start;
  start.covariance.diagonal() << 1, 1, 0.01;
  ekf.start(start);
  Smoother smoother;
  smoother.start(0, saved(ekf));
  const auto m = fix(10, 0, 1);
  const auto c = ekf.correct(m);
  ASSERT_EQ(c.reason, Correction::Reason::kReset);
  const double opened = c.nis / c.dof, k = opened / (opened + 1);  // 100 / 2 / 2 = 25
  EXPECT_NEAR(opened, 25, 1e-9);
  smoother.correction(0, opened, saved(ekf));
  smoother.motion(1, ahead(0, 0), saved(ekf));  // nothing moves: only to have a moment before
  const auto b = smoother.beliefs(ekf, {-1, 1});
  EXPECT_NEAR(b[1].mean.x, 10 * k, 1e-9);
  EXPECT_NEAR(b[0].mean.x, 10 * k / opened, 1e-9);
}

/// A drive with fixes, and the mean squared error and NEES of its middle.
struct Middle {
  double error2 = 0, nees = 0;
};

template <int N>
Middle middleOf(uint64_t seed, bool smoothed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 1);
  EkfParams params = plain();
  if (N > 4) params.wheel_scale_sd = 0.05;
  Ekf<N> ekf(params);
  const double scale = N > 4 ? 0.05 * normal(random) : 0;
  PoseBelief start;
  start.covariance.diagonal() << 0.25, 0.25, 0.0025;
  ekf.start(start);
  mrpt::math::TPose2D truth(0.5 * normal(random), 0.5 * normal(random), 0.05 * normal(random)), middle;
  Smoother smoother;
  smoother.start(0, saved(ekf));
  PoseBelief belief;
  for (int i = 1; i <= 400; ++i) {
    const double d = 0.2, w = 0.05 * std::sin(0.05 * i);
    const auto told = ahead(d / (1 + scale), 1e-4, w, 1e-4);
    truth = moved(truth, ahead(d + 0.01 * normal(random), 0, w + 0.01 * normal(random)));
    ekf.predict(told);
    smoother.motion(i, told, saved(ekf));
    if (i % 10 == 0) {
      ekf.correct(fix(truth.x + 0.5 * normal(random), truth.y + 0.5 * normal(random), 0.5));
      smoother.correction(i, 1, saved(ekf));
    }
    if (i == 200) {
      middle = truth;
      belief = ekf.estimate();
    }
  }
  if (smoothed) belief = smoother.beliefs(ekf, {200})[0];
  const Eigen::Vector3d e(belief.mean.x - middle.x, belief.mean.y - middle.y,
                          mrpt::math::wrapToPi(belief.mean.phi - middle.phi));
  return {e.head<2>().squaredNorm(), e.dot(belief.covariance.ldlt().solve(e))};
}

template <int N>
void expectBetterAndConsistent() {
  Middle filtered, smoothed;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const Middle f = middleOf<N>(seed, false), s = middleOf<N>(seed, true);
    filtered.error2 += f.error2 / 200;
    smoothed.error2 += s.error2 / 200;
    smoothed.nees += s.nees / 200;
  }
  EXPECT_LT(smoothed.error2, 0.7 * filtered.error2);
  EXPECT_NEAR(smoothed.nees, 3, 3.5 * 0.173);  // 200 runs of 3 degrees of freedom: standard error sqrt(6 / 200)
}

TEST(Smoother, IsBetterThanTheFilterAndAsSureAsItMayBe) { expectBetterAndConsistent<3>(); }
TEST(Smoother, IsBetterThanTheFilterAndAsSureAsItMayBeWithCalibration) { expectBetterAndConsistent<8>(); }

TEST(Smoother, RefusesAFilterThatHasNone) {
  auto pf = makeParticleFilter({}, 1);
  pf->start({});
  Smoother smoother;
  smoother.start(0, saved(*pf));
  pf->predict(ahead(1, 1));
  smoother.motion(1, ahead(1, 1), saved(*pf));
  EXPECT_THROW(smoother.beliefs(*pf, {0, 1}), Error);
}

/// Smoothed estimates of a circle whose fixes arrive `late_s` after they were taken.
std::vector<Estimate> smoothedCircle(double late_s) {
  LocalizerParams params;
  params.start.pose_given = true;
  Localizer localizer(params, makeEkf(plain()), {});
  localizer.smoothAtEnd();
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, 0.5);
  std::vector<std::tuple<double, double, double>> waiting;
  for (int i = 0; i < 600; ++i) {
    const double t = 0.1 * i;
    localizer.observe(support::wheelsAt(support::kStart_s + t, support::onCircle(1.03, 0.1, t)));
    EXPECT_TRUE(localizer.takeEstimates().empty());
    const auto p = support::onCircle(1, 0.1, t + 0.03);
    if (i % 10 == 5) waiting.push_back({t + 0.03, p.x + noise(random), p.y + noise(random)});
    while (!waiting.empty() && std::get<0>(waiting.front()) + late_s < t + 0.1) {
      const auto [when, x, y] = waiting.front();
      localizer.observe(support::positionAt(support::kStart_s + when, x, y));
      waiting.erase(waiting.begin());
    }
  }
  localizer.finish();
  return localizer.takeEstimates();
}

TEST(LocalizerSmoothing, GivesTheSameForFixesThatArriveLate) {
  const auto in_time = smoothedCircle(0), late = smoothedCircle(1.5);
  ASSERT_EQ(in_time.size(), late.size());
  ASSERT_GT(in_time.size(), 500u);
  for (size_t i = 0; i + 20 < late.size(); ++i) {  // the last fixes do not arrive before the end
    ASSERT_EQ(in_time[i].time_s, late[i].time_s);
    ASSERT_NEAR(in_time[i].belief.mean.x, late[i].belief.mean.x, 0.3) << i;
  }
  for (size_t i = 0; i < 200; ++i) ASSERT_NEAR(in_time[i].belief.mean.x, late[i].belief.mean.x, 1e-3) << i;
}

}  // namespace
}  // namespace sidestep
