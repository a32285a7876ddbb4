// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/localization_scenario.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/topography/conversions.h>

#include <cmath>

#include "core/errors.h"
#include "simulation/observations.h"

namespace sidestep {
namespace {

const std::string kShare = std::string(SIDESTEP_SOURCE) + "/share/scenarios/";

/// Nothing wrong with any sensor.
LocalizationScenarioParams perfect() {
  LocalizationScenarioParams p;
  p.trajectory.kind = "sinusoid";
  p.trajectory.duration_s = 20;
  p.trajectory.w_amplitude = 0.3;
  p.encoders.v_sd = p.encoders.w_sd = 0;
  p.imu.heading_sd = 0;
  p.gps.sd_m = 0;
  return p;
}

LocalizationScenarioParams fromFile(const std::string& name) {
  LocalizationScenarioParams p;
  std::string kind;
  readYaml(kShare + name, [&](ParamVisitor& v) {
    v.choice("kind", kind, {"localization"}, "");
    p.visit(v);
  });
  return p;
}

struct Moments {
  double n = 0, sum = 0, squares = 0;
  void add(double x) { n += 1, sum += x, squares += x * x; }
  double mean() const { return sum / n; }
  double sd() const { return std::sqrt(squares / n - mean() * mean()); }
};

TEST(LocalizationScenario, PerfectSensorsTellTheTruth) {
  const LocalizationScenario scenario(perfect());
  const auto steps = scenario.generate(1);
  ASSERT_EQ(steps.size(), 2001u);
  size_t fixes = 0;
  for (const auto& s : steps) {
    // Chords at half the turn leave (dt w)^2 / 24 of each way: 4e-7 of 40 m.
    EXPECT_NEAR(s.odometry.pose.x, s.truth.pose.x, 2e-5);
    EXPECT_NEAR(s.odometry.pose.y, s.truth.pose.y, 2e-5);
    EXPECT_NEAR(std::remainder(s.odometry.pose.phi - s.truth.pose.phi, 2 * M_PI), 0, 1e-11);
    if (s.imu) {
      EXPECT_DOUBLE_EQ(s.imu->yaw, s.truth.pose.phi);
      EXPECT_DOUBLE_EQ(s.imu->yaw_rate, s.truth.w);
    }
    if (s.gps) {
      EXPECT_EQ(s.gps->x, s.truth.pose.x);
      ++fixes;
    }
  }
  EXPECT_EQ(fixes, 200u);  // 10 Hz, the first after 0.1 s
  EXPECT_FALSE(steps[0].imu || steps[0].gps);
  EXPECT_TRUE(steps[10].gps && steps[1].imu);
}

TEST(LocalizationScenario, NoiseHasTheSpreadOfQAndR) {
  const LocalizationScenario scenario(fromFile("circle.yaml"));
  Moments v, w, yaw, x, y;
  for (uint64_t seed = 0; seed < 10; ++seed)
    for (const auto& s : scenario.generate(seed)) {
      if (s.time_s > 0) v.add(s.odometry.v - 2), w.add(s.odometry.w - 0.1);
      if (s.imu) yaw.add(std::remainder(s.imu->yaw - s.truth.pose.phi, 2 * M_PI));
      if (s.gps) x.add(s.gps->x - s.truth.pose.x), y.add(s.gps->y - s.truth.pose.y);
    }
  // The sd of an sd is sd / sqrt(2 n), of a mean sd / sqrt(n); four of them.
  const auto expect = [](const Moments& m, double sd) {
    EXPECT_NEAR(m.mean(), 0, 4 * sd / std::sqrt(m.n));
    EXPECT_NEAR(m.sd(), sd, 4 * sd / std::sqrt(2 * m.n));
  };
  EXPECT_EQ(v.n, 63000);
  expect(v, 0.1);
  expect(w, std::sqrt(0.0685));
  expect(yaw, std::sqrt(0.0685));
  expect(x, 1);
  expect(y, 1);
}

TEST(LocalizationScenario, TheSameSeedSaysTheSameAndAnotherDoesNot) {
  const LocalizationScenario scenario(fromFile("sinusoid.yaml"));
  const auto a = scenario.generate(7), b = scenario.generate(7), c = scenario.generate(8);
  EXPECT_EQ(a.back().odometry.pose.x, b.back().odometry.pose.x);
  EXPECT_EQ(a[5000].imu->yaw, b[5000].imu->yaw);
  EXPECT_NE(a.back().odometry.pose.x, c.back().odometry.pose.x);
}

TEST(LocalizationScenario, WhatIsLostLeavesTheOtherReadingsAsTheyWere) {
  auto p = fromFile("roof-curve.yaml");
  p.roof.loses = "none";
  const auto whole = LocalizationScenario(p).generate(3);
  p.roof.loses = "all";
  p.gps.outages = {{15, 16}};
  const auto roofed = LocalizationScenario(p).generate(3);
  ASSERT_EQ(whole.size(), 501u);
  for (size_t i = 1; i < whole.size(); ++i) {
    const double t = whole[i].time_s;
    const bool roof = t >= p.roof.from_s && t < p.roof.to_s;
    ASSERT_TRUE(whole[i].gps && whole[i].imu && whole[i].imu->has_yaw);
    EXPECT_EQ(roofed[i].gps.has_value(), !roof && !(t >= 15 && t < 16)) << t;
    EXPECT_EQ(roofed[i].imu->has_yaw, !roof) << t;
    EXPECT_EQ(roofed[i].odometry.pose.x, whole[i].odometry.pose.x);
    if (roofed[i].gps) {
      EXPECT_EQ(roofed[i].gps->x, whole[i].gps->x);
    }
  }
  p.roof.loses = "theta";
  EXPECT_TRUE(LocalizationScenario(p).generate(3)[250].gps.has_value());
  p.roof.loses = "xy";
  EXPECT_TRUE(LocalizationScenario(p).generate(3)[250].imu->has_yaw);
}

TEST(LocalizationScenario, TheScenariosOfChapterThreeHaveItsNumbers) {
  const auto sinusoid = LocalizationScenario(fromFile("sinusoid.yaml")).truth();
  EXPECT_EQ(sinusoid.size(), 5201u);
  EXPECT_NEAR(sinusoid.back().pose.x, 76, 1e-4);
  EXPECT_NEAR(sinusoid.back().pose.y, 32, 1e-4);
  EXPECT_NEAR(sinusoid.back().pose.phi, 28 * M_PI / 180, 1e-8);
  for (const auto& s : sinusoid) EXPECT_LE(std::abs(s.w), 0.4);
  const auto curve = LocalizationScenario(fromFile("roof-curve.yaml")).truth();
  EXPECT_EQ(curve.size(), 501u);
  EXPECT_NEAR(curve.back().pose.x, 12, 1e-6);
  EXPECT_NEAR(curve.back().pose.y, 8, 1e-6);
  for (const auto& s : curve) EXPECT_DOUBLE_EQ(s.v, 0.8);
  EXPECT_EQ(LocalizationScenario(fromFile("circle.yaml")).truth().size(), 6301u);
}

TEST(Encoders, WheelsOfUnequalSizeTurnAStraightLineIntoACircle) {
  // The right wheel is 2 % larger than thought: it turns 1 / 1.02 as often. The robot reads s (1 + 1 / 1.02) / 2 and a
  // turn of s (1 / 1.02 - 1) / 0.4 for each way s.
  auto p = perfect();
  p.trajectory.w_amplitude = 0;
  p.encoders.right_scale = 1.02;
  const auto steps = LocalizationScenario(p).generate(1);
  EXPECT_NEAR(steps[1].odometry.distance_m, 0.02 * (1 + 1 / 1.02) / 2, 1e-15);
  EXPECT_NEAR(steps[1].odometry.turn_rad, 0.02 * (1 / 1.02 - 1) / 0.4, 1e-15);
}

TEST(Encoders, AWiderTrackReadsAsMoreTurn) {
  auto p = perfect();
  p.trajectory.kind = "circle";
  p.encoders.track_scale = 1.05;
  const auto steps = LocalizationScenario(p).generate(1);
  EXPECT_NEAR(steps[1].odometry.turn_rad, 1.05 * 0.001, 1e-15);
  EXPECT_NEAR(steps[1].odometry.distance_m, 0.02, 1e-15);
}

TEST(Encoders, TicksAreWholeAndNoneIsLost) {
  auto p = perfect();
  p.encoders.tick_m = 0.003;
  const LocalizationScenario scenario(p);
  double left = 0, right = 0;
  for (const auto& s : scenario.generate(1)) {
    left += s.truth.distance_m - 0.2 * s.truth.turn_rad;
    right += s.truth.distance_m + 0.2 * s.truth.turn_rad;
    EXPECT_NEAR(static_cast<double>(s.odometry.left_ticks), std::floor(left / 0.003 + 1e-9), 1e-9);
    EXPECT_NEAR(static_cast<double>(s.odometry.right_ticks), std::floor(right / 0.003 + 1e-9), 1e-9);
  }
}

TEST(Encoders, SlipAddsToTheWayOnAverage) {
  auto p = perfect();
  p.trajectory.duration_s = 200;
  p.encoders.slip_mean = 0.1, p.encoders.slip_sd = 0.05, p.encoders.slip_correlation_s = 0.1;
  Moments slip;
  for (const auto& s : LocalizationScenario(p).generate(1))
    if (s.time_s > 0) slip.add(s.odometry.distance_m / s.truth.distance_m - 1);
  // Two wheels: sd 0.05 / sqrt(2); 200 s hold 1000 stretches of 2 tau.
  EXPECT_NEAR(slip.mean(), 0.1, 4 * 0.0354 / std::sqrt(1000));
  EXPECT_NEAR(slip.sd(), 0.0354, 4 * 0.0354 / std::sqrt(2000));
}

TEST(Imu, OffsetDriftAndGyroErrorsAddUp) {
  auto p = perfect();
  p.trajectory.w_amplitude = 0;
  p.imu.heading_offset = 0.2, p.imu.heading_drift = 0.01;
  p.imu.gyro_bias = 0.03, p.imu.gyro_scale = 1.1;
  const auto steps = LocalizationScenario(p).generate(1);
  EXPECT_NEAR(steps[1000].imu->yaw, 0.2 + 0.01 * 10, 1e-12);
  EXPECT_NEAR(steps[1000].imu->yaw_rate, 0.03, 1e-12);
}

TEST(Gps, AnErrorThatStaysAlikeHasItsSpreadAndItsTime) {
  auto p = perfect();
  p.trajectory.step_s = 0.1, p.trajectory.duration_s = 20000;
  p.imu.rate_hz = 0;
  p.gps.correlated_sd_m = 2, p.gps.correlation_s = 1;
  Moments error, product;
  double last = 0;
  for (const auto& s : LocalizationScenario(p).generate(5)) {
    if (!s.gps) continue;
    const double e = s.gps->x - s.truth.pose.x;
    error.add(e), product.add(e * last);
    last = e;
  }
  EXPECT_NEAR(error.sd(), 2, 4 * 2 / std::sqrt(20000.0));
  EXPECT_NEAR(product.mean() / 4, std::exp(-0.1), 4 * 1.5 / std::sqrt(10000.0));
}

TEST(LocalizationScenario, ARateBeyondTheStepsIsRefused) {
  auto p = perfect();
  p.gps.rate_hz = 101;
  try {
    p.check();
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_STREQ(e.what(), "gps.rate_hz: faster than one reading a step; make trajectory.step_s shorter");
  }
}

TEST(Observations, SayWhatTheStepSays) {
  auto p = perfect();
  p.encoders.tick_m = 0.001;
  const auto step = LocalizationScenario(p).generate(1)[500];
  std::vector<std::string> labels;
  tellObservations(step, p.encoders, p.gps, [&](const mrpt::obs::CObservation& o) {
    labels.push_back(o.sensorLabel);
    EXPECT_NEAR(mrpt::Clock::toDouble(o.timestamp), kSimulationStart_s + 5, 1e-6);
    if (const auto* gps = dynamic_cast<const mrpt::obs::CObservationGPS*>(&o)) {
      const auto at =
          gps->getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().getAsStruct<mrpt::topography::TGeodeticCoords>();
      mrpt::math::TPoint3D enu;
      mrpt::topography::geodeticToENU_WGS84(at, enu, {p.gps.datum_lat_deg, p.gps.datum_lon_deg, p.gps.datum_height_m});
      // MRPT's way back from the Earth's centre is one step of Bowring's: good to some 0.01 mm.
      EXPECT_NEAR(enu.x, step.gps->x, 1e-4);
      EXPECT_NEAR(enu.y, step.gps->y, 1e-4);
    }
    if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&o)) {
      EXPECT_EQ(odometry->encoderLeftTicks, step.odometry.left_ticks);
      EXPECT_EQ(odometry->odometry.x(), step.odometry.pose.x);
    }
  });
  EXPECT_EQ(labels, (std::vector<std::string>{"odometry", "imu", "gps", "ground_truth"}));
}

}  // namespace
}  // namespace sidestep
