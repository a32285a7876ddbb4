// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/laser_trial.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <array>
#include <cmath>

#include "core/errors.h"
#include "evaluation/experiments/map_drive.h"
#include "localization/filters/scan_model.h"
#include "localization/sensors/scan.h"
#include "support/room.h"
#include "support/temporary_folder.h"

namespace sidestep {
namespace {

using mrpt::math::TPose2D;

double apart(const TPose2D& a, const TPose2D& b) { return std::hypot(a.x - b.x, a.y - b.y); }

TPose2D odometryOf(const Reading& e) {
  return dynamic_cast<const mrpt::obs::CObservationOdometry&>(*e.observation).odometry.asTPose();
}

MapDriveParams seconds(double duration_s) {
  MapDriveParams p;
  p.duration_s = duration_s;
  p.laser.beams = 91;
  return p;
}

TEST(MapDrive, KeepsItsClearanceAndSeesTheWallsOfTheMap) {
  const auto map = support::randomRoom(3);
  const auto field = distanceField(map);
  const auto drive = driveOnMap(map, seconds(60), 1);
  ASSERT_EQ(drive.truth.size(), 601u);
  double way = 0;
  for (size_t i = 1; i < drive.truth.size(); ++i) {
    EXPECT_GE(field.clearance(drive.truth[i].pose.x, drive.truth[i].pose.y), 0.4 - 0.01);
    way += apart(drive.truth[i].pose, drive.truth[i - 1].pose);
    EXPECT_LE(apart(drive.truth[i].pose, drive.truth[i - 1].pose), 0.05 + 1e-9);  // 0.5 m/s
  }
  EXPECT_GT(way, 10);
  const ScanModel model(map, {});
  size_t scans = 0;
  for (const auto& e : drive.entries) {
    if (e.kind != SensorKind::kLaser) continue;
    const auto scan = readScan({}, dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*e.observation));
    const auto at = static_cast<size_t>(std::llround((e.time_s - drive.start_s) * 10));
    EXPECT_GT(model.explained(*scan, drive.truth[at].pose), 0.9);
    ++scans;
  }
  EXPECT_EQ(scans, 120u);  // 2 Hz; the first after half a second
}

TEST(MapDrive, TheSameSeedIsTheSameDriveAndClutterShortensBeams) {
  const auto map = support::randomRoom(3);
  auto params = seconds(20);
  const auto a = driveOnMap(map, params, 5), b = driveOnMap(map, params, 5), c = driveOnMap(map, params, 6);
  ASSERT_EQ(a.entries.size(), b.entries.size());
  EXPECT_EQ(
      odometryOf(a.entries.back().kind == SensorKind::kOdometry ? a.entries.back() : a.entries[a.entries.size() - 2]),
      odometryOf(b.entries.back().kind == SensorKind::kOdometry ? b.entries.back() : b.entries[b.entries.size() - 2]));
  EXPECT_NE(a.truth.back().pose, c.truth.back().pose);
  params.clutter = 40;
  const auto cluttered = driveOnMap(map, params, 5);
  const ScanModel model(map, {});
  double explained = 0, n = 0;
  for (const auto& e : cluttered.entries) {
    if (e.kind != SensorKind::kLaser) continue;
    const auto scan = readScan({}, dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*e.observation));
    const auto at = static_cast<size_t>(std::llround((e.time_s - cluttered.start_s) * 10));
    explained += model.explained(*scan, cluttered.truth[at].pose);
    ++n;
  }
  EXPECT_LT(explained / n, 0.8);
}

TEST(LaserTrial, ACarriedPieceJumpsInTruthAndNotInOdometry) {
  const auto drive = driveOnMap(support::randomRoom(3), seconds(120), 1);
  LaserTrialParams params;
  params.start = "truth";
  params.length_s = 40;
  params.carried_after_s = 15;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const auto trial = makeTrial(drive, params, seed);
    int jumps = 0;
    for (size_t i = 1; i < trial.drive.truth.size(); ++i) {
      const double step = apart(trial.drive.truth[i].pose, trial.drive.truth[i - 1].pose);
      if (step < 1) continue;
      ++jumps;
      EXPECT_GT(step, 2.5);
      EXPECT_NEAR(trial.drive.truth[i].time_s - trial.drive.start_s, 15, 0.2);
    }
    EXPECT_EQ(jumps, 1);
    EXPECT_NEAR(trial.drive.truth.back().time_s - trial.drive.start_s, 40, 0.5);
    std::optional<TPose2D> before;
    for (const auto& e : trial.drive.entries) {
      if (e.kind != SensorKind::kOdometry) continue;
      const auto p = odometryOf(e);
      EXPECT_LT(before ? apart(p, *before) : 0, 0.2);
      before = p;
    }
    EXPECT_EQ(trial.start, trial.drive.truth.front().pose);
  }
}

TEST(LaserTrial, StartsAreWhatWasAskedFor) {
  const auto drive = driveOnMap(support::randomRoom(3), seconds(120), 1);
  LaserTrialParams params;
  params.length_s = 20;
  EXPECT_FALSE(makeTrial(drive, params, 1).start);
  params.start = "off";
  const auto off = makeTrial(drive, params, 1);
  EXPECT_NEAR(apart(*off.start, off.drive.truth.front().pose), 0.7, 1e-9);
  EXPECT_NEAR(std::abs(off.start->phi - off.drive.truth.front().pose.phi), 10 * M_PI / 180, 1e-9);
  params.start = "wrong";
  const auto wrong = makeTrial(drive, params, 1);
  EXPECT_GT(apart(*wrong.start, wrong.drive.truth.front().pose), 3);
  params.length_s = 1000;
  EXPECT_THROW(makeTrial(drive, params, 1), DatasetError);
}

TEST(LaserMetrics, OfAHandfulOfSamples) {
  std::vector<LaserSample> samples;
  const auto add = [&](double time_s, double error, double told) {
    LaserSample s;
    s.pair.time_s = time_s;
    s.pair.estimate = {error, 0, 0};
    s.pair.covariance = Eigen::Matrix3d::Identity();
    s.lost_told = told;
    samples.push_back(s);
  };
  add(0, 3, 0.9);    // lost, told 0.9: -0.1 in the fifth gap
  add(1, 0.5, 0.5);  // not lost: +0.5 in the third
  add(2, 2, 0.1);    // lost: -0.9 in the first
  add(3, 0.2, 0.1);  // +0.1 in the first
  const LaserNumbers numbers = measureTrial(samples, 1.5);
  const auto of = [&](const std::string& name) {
    for (const auto& row : laserMetrics())
      if (row.info.name == name) return row.value(numbers);
    throw std::out_of_range(name);
  };
  EXPECT_DOUBLE_EQ(of("mean_error_m"), 1.1);  // of the last two
  EXPECT_DOUBLE_EQ(of("max_error_m"), 2);
  EXPECT_DOUBLE_EQ(of("final_error_m"), 0.2);
  EXPECT_EQ(of("found"), 1);
  EXPECT_EQ(of("found_after_s"), 3);
  EXPECT_DOUBLE_EQ(of("lost_share"), 0.5);
  EXPECT_DOUBLE_EQ(of("lost_told"), 0.4);
  EXPECT_NEAR(of("lost_brier"), (0.01 + 0.25 + 0.81 + 0.01) / 4, 1e-12);
  EXPECT_NEAR(of("lost_gap_1"), -0.2, 1e-12);
  EXPECT_EQ(of("lost_gap_2"), 0);
  EXPECT_NEAR(of("lost_gap_3"), 0.125, 1e-12);
  EXPECT_NEAR(of("lost_gap_5"), -0.025, 1e-12);
}

/// In rooms that nothing was fitted to, with things that the map does not know: it finds itself, and its word on being
/// lost is as good as its word.
TEST(LaserTrial, InNewRoomsTheRobotIsFoundAndTheProbabilityOfBeingLostIsCalibrated) {
  const support::TemporaryFolder folder;
  const std::array<const char*, 4> starts = {"anywhere", "wrong", "truth", "off"};
  double samples = 0, lost = 0, told = 0, found = 0, runs = 0;
  std::array<double, 5> gaps{};
  for (uint64_t seed = 1; seed <= 24; ++seed) {
    const auto map = support::randomRoom(seed);
    const std::string file = (folder / ("room" + std::to_string(seed) + ".yaml")).string();
    writeRosMap(map, file);
    auto driving = seconds(90);
    driving.clutter = static_cast<int>(seed % 3) * 4;
    LaserTrialParams params;
    params.start = starts[seed % 4];
    params.length_s = 50;
    params.carried_after_s = params.start == std::string("truth") ? 15 : 0;
    LocalizeConfig config;
    config.filter = "mcl";
    config.sensors = {"odometry", "laser"};
    config.map = file;
    const auto out = localizeTrial(makeTrial(driveOnMap(map, driving, seed), params, seed), config, seed);
    for (const auto& s : out) {
      const bool is_lost = apart(s.pair.estimate, s.pair.truth) > 1;
      ASSERT_GE(s.lost_told, 0);
      ASSERT_LE(s.lost_told, 1);
      ++samples, lost += is_lost, told += s.lost_told;
      gaps[std::min<size_t>(4, static_cast<size_t>(5 * s.lost_told))] += s.lost_told - is_lost;
    }
    ++runs, found += apart(out.back().pair.estimate, out.back().pair.truth) < 1;
  }
  double calibration_error = 0;
  for (const double g : gaps) calibration_error += std::abs(g) / samples;
  RecordProperty("calibration_error", std::to_string(calibration_error));
  EXPECT_GE(found / runs, 0.9);
  EXPECT_GT(lost / samples, 0.02);
  EXPECT_NEAR(told / samples, lost / samples, 0.06);
  EXPECT_LT(calibration_error, 0.08) << told / samples << " told, " << lost / samples << " lost";
}

}  // namespace
}  // namespace sidestep
