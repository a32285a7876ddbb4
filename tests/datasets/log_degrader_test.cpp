// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_degrader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"
#include "datasets/planar_reading.h"
#include "support/log_worlds.h"

namespace sidestep {
namespace {

using worlds::kStart_s;

Reading entryOf(SensorKind kind, std::shared_ptr<mrpt::obs::CObservation> o) {
  return {mrpt::Clock::toDouble(o->timestamp), kind, o->sensorLabel, o};
}

/// Each second odometry at x = t and a truth like it; half a second later heading 0.1 t with yaw rate 0.5, and a fix.
std::vector<Reading> world(int seconds) {
  std::vector<Reading> out;
  for (int t = 0; t < seconds; ++t) {
    out.push_back(entryOf(SensorKind::kOdometry,
                          std::make_shared<mrpt::obs::CObservationOdometry>(worlds::odometry(kStart_s + t, t, 1))));
    auto truth = std::make_shared<mrpt::obs::CObservationRobotPose>(worlds::pose(kStart_s + t));
    truth->pose.mean = mrpt::poses::CPose3D(t, 100, 0, 0, 0, 0);
    out.push_back(entryOf(SensorKind::kGroundTruth, truth));
    auto imu = std::make_shared<mrpt::obs::CObservationIMU>(worlds::imu(kStart_s + t + 0.5, 0.5));
    imu->set(mrpt::obs::IMU_YAW, 0.1 * t);
    out.push_back(entryOf(SensorKind::kImu, imu));
    out.push_back(entryOf(SensorKind::kGps, std::make_shared<mrpt::obs::CObservationGPS>(
                                                worlds::gps(kStart_s + t + 0.5, 36.7 + 1e-5 * t))));
  }
  return out;
}

struct Degraded {
  std::vector<Reading> entries;
  std::vector<LogDegrader::EventCount> counts;
  std::vector<Reading> of(SensorKind kind) const {
    std::vector<Reading> out;
    for (const auto& e : entries)
      if (e.kind == kind) out.push_back(e);
    return out;
  }
};

Degraded degraded(const std::string& yaml, const std::vector<Reading>& in) {
  DegradeScript script;
  readYamlText(yaml, "script.yaml", [&](ParamVisitor& v) { script.visit(v); });
  Degraded out;
  LogDegrader degrader(script, [&](const Reading& e) { out.entries.push_back(e); });
  for (const auto& e : in) degrader.push(e);
  degrader.finish();
  out.counts = degrader.counts();
  return out;
}

std::vector<double> seconds(const std::vector<Reading>& entries) {
  std::vector<double> out;
  for (const auto& e : entries) out.push_back(std::round((e.time_s - kStart_s) * 1000) / 1000);
  return out;
}

PlanarReading planar(const Reading& e) { return readPlanar(*e.observation); }

TEST(LogDegrader, DropsWithinItsWindowAndNothingElse) {
  const auto out = degraded("events: {tunnel: {label: gps, from_s: 2, to_s: 4.5}}", world(6));
  EXPECT_EQ(seconds(out.of(SensorKind::kGps)), (std::vector<double>{0.5, 1.5, 4.5, 5.5}));
  EXPECT_EQ(out.entries.size(), 22u);
  ASSERT_EQ(out.counts.size(), 1u);
  EXPECT_EQ(out.counts[0].met, 2u);
  EXPECT_EQ(out.counts[0].hit, 2u);
}

TEST(LogDegrader, DropsTheHeadingOfAnImuAndLeavesItsGyro) {
  const auto in = world(3);
  const auto out = degraded("events: {e: {label: imu, components: theta, from_s: 1}}", in).of(SensorKind::kImu);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_TRUE(planar(out[0]).has_theta);
  EXPECT_FALSE(planar(out[1]).has_theta);
  EXPECT_TRUE(planar(out[1]).has_rate);
  EXPECT_TRUE(planar(in[6]).has_theta) << "what went in was changed";
}

TEST(LogDegrader, ThinKeepsOneOfSoMany) {
  const auto out = degraded("events: {e: {label: gps, do: thin, keep_every: 3, from_s: 1}}", world(8));
  EXPECT_EQ(seconds(out.of(SensorKind::kGps)), (std::vector<double>{0.5, 1.5, 4.5, 7.5}));
}

TEST(LogDegrader, DelayStampsLateAndStaysInOrder) {
  const auto out = degraded("events: {e: {label: gps, do: delay, delay_s: 1.7}}", world(3));
  EXPECT_EQ(seconds(out.of(SensorKind::kGps)), (std::vector<double>{2.2, 3.2, 4.2}));
  EXPECT_EQ(out.entries.size(), 12u);
  for (size_t i = 1; i < out.entries.size(); ++i) EXPECT_LE(out.entries[i - 1].time_s, out.entries[i].time_s);
  const auto first = out.of(SensorKind::kGps)[0];
  EXPECT_NEAR(mrpt::Clock::toDouble(first.observation->timestamp), first.time_s, 1e-6);
}

TEST(LogDegrader, FreezeRepeatsTheFirstValueOfEachWindow) {
  const auto out = degraded("events: {e: {label: imu, do: freeze, components: theta, from_s: 1, to_s: 4}}", world(6))
                       .of(SensorKind::kImu);
  const double expected[] = {0, 0.1, 0.1, 0.1, 0.4, 0.5};
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(planar(out[i]).theta, expected[i], 1e-12) << i;
  EXPECT_EQ(seconds(out), (std::vector<double>{0.5, 1.5, 2.5, 3.5, 4.5, 5.5}));
}

TEST(LogDegrader, BiasMovesFixesByMetres) {
  const auto in = world(2);
  const auto out =
      degraded("events: {e: {label: gps, do: bias, x_m: 30, y_m: -40, from_s: 1}}", in).of(SensorKind::kGps);
  EXPECT_EQ(planar(out[0]).x, planar(in[3]).x);
  EXPECT_NEAR(planar(out[1]).x - planar(in[7]).x, 30, 1e-6);
  EXPECT_NEAR(planar(out[1]).y - planar(in[7]).y, -40, 1e-6);
}

TEST(LogDegrader, SpikesAreAsFarOffAndAsFrequentAsSaid) {
  const auto in = world(2000);
  const auto out =
      degraded("events: {e: {label: gps, do: spike, probability: 0.1, spike_m: 20}}", in).of(SensorKind::kGps);
  int spikes = 0;
  for (size_t i = 0; i < out.size(); ++i) {
    const double off =
        std::hypot(planar(out[i]).x - planar(in[4 * i + 3]).x, planar(out[i]).y - planar(in[4 * i + 3]).y);
    if (off == 0) continue;
    EXPECT_NEAR(off, 20, 1e-4);
    ++spikes;
  }
  EXPECT_NEAR(spikes, 200, 4 * std::sqrt(2000 * 0.1 * 0.9));
}

TEST(LogDegrader, NoiseBecomesSoManyTimesWhatItWas) {
  // sd 2 m as it is, 3 times that: what is added has variance 4 (9 - 1) = 32.
  const auto in = world(4000);
  const auto out = degraded("events: {e: {label: gps, do: noise, sd_m: 2, noise_scale: 3}}", in).of(SensorKind::kGps);
  double squares = 0;
  for (size_t i = 0; i < out.size(); ++i) squares += std::pow(planar(out[i]).x - planar(in[4 * i + 3]).x, 2);
  EXPECT_NEAR(squares / 4000, 32, 4 * 32 * std::sqrt(2.0 / 4000));
}

TEST(LogDegrader, AZoneIsWhereTheRobotIs) {
  const std::string zone =
      "zones: {roof: {polygon: [{x: 1.5, y: 90}, {x: 4.5, y: 90}, {x: 4.5, y: 110}, {x: 1.5, y: 110}]}}\n";
  const std::string event = "events: {e: {label: gps, zone: roof}}\n";
  const auto by_truth = degraded(zone + event, world(6));
  EXPECT_EQ(seconds(by_truth.of(SensorKind::kGps)), (std::vector<double>{0.5, 1.5, 5.5}));
  // By odometry the robot is at y = 0, outside; with its origin at (1, 100) it enters a second earlier.
  EXPECT_EQ(degraded(zone + event + "pose_from: odometry", world(6)).of(SensorKind::kGps).size(), 6u);
  const auto moved = degraded(zone + event + "pose_from: odometry\nstart_x_m: 1\nstart_y_m: 100", world(6));
  EXPECT_EQ(seconds(moved.of(SensorKind::kGps)), (std::vector<double>{0.5, 4.5, 5.5}));
}

TEST(LogDegrader, TheSameSeedDoesTheSameAndAnotherEventLeavesItAlone) {
  const std::string noise = "n: {label: gps, do: noise, sd_m: 1}";
  const auto a = degraded("events: {" + noise + "}", world(50)).of(SensorKind::kGps);
  const auto b = degraded("events: {" + noise + ", d: {label: imu, probability: 0.5}}", world(50)).of(SensorKind::kGps);
  const auto c = degraded("seed: 2\nevents: {" + noise + "}", world(50)).of(SensorKind::kGps);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(planar(a[i]).x, planar(b[i]).x);
    EXPECT_NE(planar(a[i]).x, planar(c[i]).x);
  }
}

TEST(LogDegrader, AJumpCutsTheLogAndClosesTheGapInTimeAndOdometry) {
  // Seconds 3 .. 6 are gone and second 7 is stamped 3. The truth jumps from x = 2 to x = 7, the wheels go on from 2.
  auto in = world(10);
  for (auto& e : in)
    if (e.kind == SensorKind::kOdometry) {
      auto& o = dynamic_cast<mrpt::obs::CObservationOdometry&>(*e.observation);
      o.hasEncodersInfo = true;
      o.encoderLeftTicks = static_cast<int32_t>(100 * o.odometry.x());
    }
  const auto out = degraded("events: {carried: {do: jump, from_s: 3, to_s: 7}}", in);
  EXPECT_EQ(seconds(out.of(SensorKind::kOdometry)), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(seconds(out.of(SensorKind::kGps)), (std::vector<double>{0.5, 1.5, 2.5, 3.5, 4.5, 5.5}));
  const double wheels[] = {0, 1, 2, 2, 3, 4}, truth[] = {0, 1, 2, 7, 8, 9};
  for (size_t i = 0; i < 6; ++i) {
    const auto o = out.of(SensorKind::kOdometry)[i], t = out.of(SensorKind::kGroundTruth)[i];
    EXPECT_NEAR(planar(o).x, wheels[i], 1e-12) << i;
    EXPECT_NEAR(planar(t).x, truth[i], 1e-12) << i;
    EXPECT_EQ(dynamic_cast<mrpt::obs::CObservationOdometry&>(*o.observation).encoderLeftTicks, 100 * wheels[i]) << i;
    EXPECT_NEAR(mrpt::Clock::toDouble(o.observation->timestamp), o.time_s, 1e-6);
  }
  EXPECT_EQ(planar(in[4 * 7]).x, 7) << "what went in was changed";
  EXPECT_EQ(out.counts[0].hit, 16u);
}

TEST(LogDegrader, AJumpTurnsOdometryIntoTheFrameOfItsLastReading) {
  auto in = world(4);
  for (int t = 0; t < 2; ++t)  // before the cut it looks back from (5, 5)
    dynamic_cast<mrpt::obs::CObservationOdometry&>(*in[4 * static_cast<size_t>(t)].observation).odometry =
        mrpt::poses::CPose2D(5, 5, M_PI);
  auto& turned = dynamic_cast<mrpt::obs::CObservationOdometry&>(*in[4 * 2].observation);
  turned.odometry = mrpt::poses::CPose2D(2, 0, M_PI / 2);  // at the first reading after the cut it looks left
  auto& ahead = dynamic_cast<mrpt::obs::CObservationOdometry&>(*in[4 * 3].observation);
  ahead.odometry = mrpt::poses::CPose2D(2, 1, M_PI / 2);  // and then goes a metre ahead
  const auto out = degraded("events: {carried: {do: jump, from_s: 1, to_s: 2}}", in).of(SensorKind::kOdometry);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_NEAR(planar(out[1]).x, 5, 1e-12);
  EXPECT_NEAR(planar(out[1]).y, 5, 1e-12);
  EXPECT_NEAR(planar(out[2]).x, 4, 1e-12);
  EXPECT_NEAR(planar(out[2]).y, 5, 1e-12);
  EXPECT_NEAR(std::abs(planar(out[2]).theta), M_PI, 1e-12);
}

TEST(LogDegrader, TwoJumpsAddUpAndDelaysCrossThem) {
  const auto out = degraded(
      "events: {late: {label: gps, do: delay, delay_s: 1.2}, a: {do: jump, from_s: 2, to_s: 4}, b: {do: jump, from_s: "
      "6, to_s: 7}}",
      world(9));
  EXPECT_EQ(seconds(out.of(SensorKind::kOdometry)), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(seconds(out.of(SensorKind::kGps)), (std::vector<double>{1.7, 2.7, 3.7, 4.7, 5.7, 6.7}));
  for (size_t i = 1; i < out.entries.size(); ++i) EXPECT_LE(out.entries[i - 1].time_s, out.entries[i].time_s);
  const double wheels[] = {0, 1, 1, 2, 2, 3};  // each cut costs the metre between the readings beside it
  for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(planar(out.of(SensorKind::kOdometry)[i]).x, wheels[i], 1e-12) << i;
}

std::string errorOf(const std::string& yaml) {
  try {
    degraded(yaml, world(2));
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "";
}

TEST(LogDegrader, WhatCannotBeDoneIsRefusedByName) {
  EXPECT_EQ(errorOf("zones: {roof: {polygon: [{x: 0, y: 0}, {x: 1, y: 0}, {x: 1, y: 1}]}}\n"
                    "events: {e: {label: gps, zone: rof}}"),
            "events.e.zone = rof: no such zone; did you mean 'roof'?");
  EXPECT_EQ(errorOf("zones: {roof: {polygon: [{x: 0, y: 0}, {x: 1, y: 0}]}}"),
            "zones.roof.polygon: has fewer than three corners");
  EXPECT_EQ(errorOf("events: {e: {do: jump, label: gps, to_s: 5}}"),
            "events.e: jump cuts the whole log; leave out label and zone");
  EXPECT_EQ(errorOf("events: {e: {do: jump, from_s: 5, to_s: 5}}"), "events.e: jump needs from_s < to_s");
  EXPECT_EQ(errorOf("events: {e: {do: jump, from_s: 5}}"), "events.e: jump needs from_s < to_s");
  EXPECT_EQ(errorOf("events: {e: {do: drop}}"), "events.e.label: is missing; name the observations that suffer");
  EXPECT_EQ(errorOf("events: {e: {label: gps, do: bias, components: theta}}"),
            "events.e: bias cannot be done to theta of gps (mrpt::obs::CObservationGPS), which has none");
  EXPECT_EQ(errorOf("events: {e: {label: odometry, components: theta}}"),
            "events.e: odometry cannot lose theta alone; components: all drops the observation");
  EXPECT_EQ(errorOf("events: {e: {label: gps, do: dorp}}"),
            "script.yaml:1: events.e.do = dorp, allowed drop, thin, delay, freeze, bias, spike, noise, jump; did you "
            "mean 'drop'?");
}

TEST(Zone, KnowsItsInsideOutsideAndItsDents) {
  const Zone u{{{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}};
  EXPECT_TRUE(u.contains({0.5, 2}));
  EXPECT_TRUE(u.contains({2.5, 2}));
  EXPECT_FALSE(u.contains({1.5, 2}));
  EXPECT_FALSE(u.contains({-1, 0.5}));
}

}  // namespace
}  // namespace sidestep
