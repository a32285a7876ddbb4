// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/drive_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/data_path.h"
#include "core/errors.h"

namespace sidestep {
namespace {

/// One pair a second; the estimate lies `errors[i]` m beside the truth.
DriveResult driveWith(const std::vector<double>& errors) {
  DriveResult r;
  for (size_t i = 0; i < errors.size(); ++i) {
    PosePair p;
    p.time_s = static_cast<double>(i);
    p.truth = {p.time_s, 0, 0};
    p.estimate = {p.time_s, errors[i], 0};
    p.covariance = Eigen::Matrix3d::Identity();
    r.pairs.push_back(p);
    r.odometry.push_back(p.estimate);
  }
  return r;
}

double value(const DriveNumbers& numbers, const std::string& name) {
  for (const auto& row : driveMetrics())
    if (row.info.name == name) return row.value(numbers);
  throw std::out_of_range(name);
}

TEST(DriveMetrics, AreThoseOfTheDissertation) {
  const auto m = measureDrive(driveWith({1, 2, 3, 2}), {}, {}, 0);
  EXPECT_DOUBLE_EQ(value(m, "mean_error_m"), 2);            // (3.18)
  EXPECT_DOUBLE_EQ(value(m, "mean_square_error_m2"), 0.5);  // (1 + 0 + 1 + 0) / 4
  EXPECT_DOUBLE_EQ(value(m, "rmse_m"), std::sqrt(18.0 / 4));
  EXPECT_DOUBLE_EQ(value(m, "max_error_m"), 3);
  EXPECT_DOUBLE_EQ(value(m, "final_error_m"), 2);
  EXPECT_DOUBLE_EQ(value(m, "mean_nees"), 4.5);  // e^2 with unit covariance: 1, 4, 9, 4
  for (const char* name : {"outage_error_m", "outage_end_error_m", "outage_added_m", "recovery_s"})
    EXPECT_TRUE(std::isnan(value(m, name))) << name;
}

TEST(DriveMetrics, ALossIsMeasuredAgainstTheTwinWithoutIt) {
  const auto twin = driveWith({1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  const auto run = driveWith({1, 1, 1, 2, 4, 6, 3, 2, 1, 1});
  const SignalLoss loss{true, true, 3, 6};  // seconds 3, 4, 5
  const auto m = measureDrive(run, errorsOf(twin), loss, 0);
  EXPECT_DOUBLE_EQ(value(m, "outage_error_m"), 4);
  EXPECT_DOUBLE_EQ(value(m, "outage_end_error_m"), 6);
  EXPECT_DOUBLE_EQ(value(m, "outage_added_m"), 5);
  EXPECT_DOUBLE_EQ(value(m, "recovery_s"), 2);  // at 8 s, the first error of 1 m again
}

TEST(DriveMetrics, WhatNeverRecoversCountsUntilTheEnd) {
  const auto m =
      measureDrive(driveWith({1, 1, 5, 5, 5, 5}), errorsOf(driveWith({1, 1, 1, 1, 1, 1})), {true, false, 2, 3}, 0);
  EXPECT_DOUBLE_EQ(value(m, "recovery_s"), 2);  // from 3 s to 5 s
}

TEST(DriveMetrics, WhatTheLossDidNotHarmIsRecoveredAtOnce) {
  const auto r = driveWith({1, 1, 1, 1, 1});
  EXPECT_EQ(value(measureDrive(r, errorsOf(r), {true, false, 1.5, 2.5}, 0), "recovery_s"), 0);
}

TEST(DriveMetrics, DeadReckoningIsMeasuredFromTheTruePoseAtTheStartOfTheLoss) {
  // Off by 5 m and 90 deg until then; from 3 s on it goes wrong by 0, 1, 2 m.
  auto r = driveWith({0, 0, 0, 0, 1, 2});
  for (auto& p : r.pairs) p.estimate = mrpt::math::TPose2D(5, 0, M_PI / 2) + p.estimate;
  const SignalLoss loss{true, true, 3, 6};
  layOntoTruthAt(loss.from_s, r);
  const auto m = measureDrive(r, {}, loss, 0);
  EXPECT_NEAR(value(m, "outage_error_m"), 1, 1e-9);
  EXPECT_NEAR(value(m, "outage_end_error_m"), 2, 1e-9);
  for (const char* name : {"outage_added_m", "recovery_s", "recovered"})
    EXPECT_TRUE(std::isnan(value(m, name))) << name;
}

TEST(DriveMetrics, SaysWhetherARunRecovered) {
  const auto twin = errorsOf(driveWith({1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(value(measureDrive(driveWith({1, 1, 5, 5, 5, 5}), twin, {true, false, 2, 3}, 0), "recovered"), 0);
  EXPECT_EQ(value(measureDrive(driveWith({1, 1, 5, 5, 1, 5}), twin, {true, false, 2, 3}, 0), "recovered"), 1);
}

TEST(DriveMetrics, ConsistencyIsByWhatAConsistentFilterHas) {
  auto r = driveWith({1, 1, 1, 1});
  r.nis = {{"gps", 400, 200, 200, 2}, {"imu", 900, 100, 100, 1}};
  r.gate_probability = 1;
  const auto m = measureDrive(r, {}, {}, 0);
  EXPECT_DOUBLE_EQ(value(m, "nees"), 1.0 / 3);
  EXPECT_DOUBLE_EQ(value(m, "nis_gps"), 1);
  EXPECT_EQ(value(m, "nis_gps_in_band"), 1);
  EXPECT_DOUBLE_EQ(value(m, "nis_imu"), 9);
  EXPECT_EQ(value(m, "nis_imu_in_band"), 0);
  EXPECT_TRUE(std::isnan(value(m, "nis_beacons")));
}

TEST(DriveMetrics, ACovarianceThatKnowsADirectionExactlySaysNothing) {
  auto r = driveWith({1, 1});
  r.pairs[0].covariance(0, 0) = 0;
  EXPECT_DOUBLE_EQ(value(measureDrive(r, {}, {}, 0), "mean_nees"), 1);
}

/// An estimate that is the truth turned by 90 deg and moved is without error once it is aligned by the first pose.
TEST(DriveMetrics, AlignmentMovesEstimateOdometryAndFixes) {
  DriveResult r;
  for (int i = 0; i < 5; ++i) {
    PosePair p;
    p.truth = {static_cast<double>(i), 0, 0};
    p.estimate = {7, 3.0 + i, M_PI / 2};
    r.pairs.push_back(p);
    r.odometry.push_back(p.estimate);
    r.fixes.push_back({7, 3.0 + i});
  }
  LocalizeConfig config;
  config.align = "first";
  align(r, config);
  for (int i = 0; i < 5; ++i) {
    const auto k = static_cast<size_t>(i);
    EXPECT_NEAR(r.pairs[k].estimate.x, i, 1e-12);
    EXPECT_NEAR(r.pairs[k].estimate.y, 0, 1e-12);
    EXPECT_NEAR(r.pairs[k].estimate.phi, 0, 1e-12);
    EXPECT_NEAR(r.odometry[k].x, i, 1e-12);
    EXPECT_NEAR(r.fixes[k].x, i, 1e-12);
  }
}

TEST(Drive, WithoutNoiseTheEstimateIsTheTruth) {
  LocalizationScenarioParams params;
  params.trajectory.duration_s = 10;
  params.encoders.v_sd = params.encoders.w_sd = 0;
  const LocalizationScenario scenario(params);
  LocalizeConfig config;
  config.sensors = {"odometry"};
  config.robot.start.pose_given = true;
  const auto r = localizeSimulated(scenario, config, {}, 1, 1);
  ASSERT_EQ(r.pairs.size(), scenario.truth().size());
  // Chords instead of arcs: each step of ds = 0.02 m at w = 0.1 rad/s is short by ds (w dt)^2 / 24, in all 1e-7 m.
  EXPECT_LT(value(measureDrive(r, {}, {}, 0), "max_error_m"), 1e-6);
}

TEST(Drive, SignalsThatAreLostDoNotArrive) {
  const LocalizationScenario scenario{LocalizationScenarioParams{}};
  LocalizeConfig config;
  config.robot.start.pose_given = true;
  const auto whole = localizeSimulated(scenario, config, {}, 3, 1);
  const auto cut = localizeSimulated(scenario, config, {true, true, 10, 20}, 3, 1);
  EXPECT_EQ(whole.fixes.size() - cut.fixes.size(), 100u);  // 10 Hz for 10 s
  EXPECT_EQ(whole.pairs[900].estimate.x, cut.pairs[900].estimate.x);
  EXPECT_NE(whole.pairs[1500].estimate.x, cut.pairs[1500].estimate.x);
}

TEST(Drive, APathMayNameTheEnvironment) {
  setenv("SIDESTEP_TEST_FOLDER", "/somewhere", 1);
  EXPECT_EQ(resolvedPath("${SIDESTEP_TEST_FOLDER}/a/../b.rawlog", "x/study.yaml"), "/somewhere/b.rawlog");
  EXPECT_EQ(resolvedPath("../maps/m.yaml", "share/studies/s.yaml"), "share/maps/m.yaml");
  unsetenv("SIDESTEP_TEST_FOLDER");
  try {
    resolvedPath("${SIDESTEP_TEST_FOLDER}/b.rawlog", "s.yaml");
    FAIL();
  } catch (const DatasetError& e) {
    EXPECT_EQ(e.code(), ExitCode::kInputMissing);
    EXPECT_EQ(
        std::string(e.what()),
        "s.yaml: ${SIDESTEP_TEST_FOLDER}/b.rawlog: the environment variable SIDESTEP_TEST_FOLDER is not set; set it "
        "to the folder of the data, or leave these scenarios out with --scenarios");
  }
}

}  // namespace
}  // namespace sidestep
