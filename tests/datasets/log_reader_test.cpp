// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_reader.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.h"
#include "support/log_worlds.h"

namespace sidestep {
namespace {

using namespace worlds;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class LogReaderTest : public testing::Test {
 protected:
  /// Writes the objects as a plain log of somebody else's and reads it.
  template <class... Objects>
  ReadLog read(const Objects&... objects) {
    store(file_, plainLog(objects...));
    return readLog(file_, options_);
  }
  TemporaryFolder folder_;
  std::string file_ = folder_ / "log.rawlog";
  LogReaderOptions options_;
};

mrpt::obs::CActionCollection action(double t_s, double forward_m) {
  mrpt::obs::CActionRobotMovement2D move;
  move.rawOdometryIncrementReading = mrpt::poses::CPose2D(forward_m, 0, 0);
  move.hasVelocities = true;
  move.velocityLocal = {1e9, 0, 0};
  if (t_s > 0) move.timestamp = mrpt::Clock::fromDouble(t_s);
  mrpt::obs::CActionCollection actions;
  actions.insert(move);
  return actions;
}

mrpt::obs::CSensoryFrame frame(double t_s) {
  mrpt::obs::CSensoryFrame out;
  auto laser = std::make_shared<mrpt::obs::CObservation2DRangeScan>(scan(t_s));
  laser->sensorLabel.clear();
  auto ranges = std::make_shared<mrpt::obs::CObservationBeaconRanges>(beacons(1, {2, 3}));
  ranges->timestamp = INVALID_TIMESTAMP;
  out.insert(ranges);
  out.insert(laser);
  return out;
}

TEST_F(LogReaderTest, WhatWasWrittenComesBackInOrder) {
  writeLog(file_, 20);
  const ReadLog log = readLog(file_);
  EXPECT_FALSE(log.end.damaged) << log.end.message;
  ASSERT_EQ(log.entries.size(), 100u);
  EXPECT_EQ(log.end.entries, 102u);  // and the two comments
  EXPECT_TRUE(log.refused.empty());
  for (size_t i = 1; i < log.entries.size(); ++i) EXPECT_GE(log.entries[i].time_s, log.entries[i - 1].time_s);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kOdometry);
  EXPECT_EQ(log.entries[3].kind, SensorKind::kLaser);
  EXPECT_EQ(log.entries[4].kind, SensorKind::kGroundTruth);
  EXPECT_NEAR(log.entries[5].time_s, kStart_s + 0.1, 1e-6);
}

TEST_F(LogReaderTest, TheHeaderOfOurLogsCanBeAskedFor) {
  writeLog(file_, 1);
  LogReader reader(file_);
  reader.next();
  EXPECT_EQ(reader.header(), "sidestep: {rawlog: 1}\nprogram: test\n");
}

TEST_F(LogReaderTest, IncrementsOfActionsAddUpToOdometryAtTheStampOfTheirFrame) {
  const ReadLog log =
      read(frame(kStart_s), action(kStart_s + 0.5, 2), frame(kStart_s + 1), action(0, 3), frame(kStart_s + 2));
  ASSERT_EQ(log.entries.size(), 8u);
  std::vector<const Reading*> odometry;
  for (const Reading& e : log.entries)
    if (e.kind == SensorKind::kOdometry) odometry.push_back(&e);
  ASSERT_EQ(odometry.size(), 2u);
  EXPECT_NEAR(odometry[0]->time_s, kStart_s + 1, 1e-6);
  EXPECT_NEAR(odometry[1]->time_s, kStart_s + 2, 1e-6);
  const auto& last = dynamic_cast<const mrpt::obs::CObservationOdometry&>(*odometry[1]->observation);
  EXPECT_DOUBLE_EQ(last.odometry.x(), 5);
  EXPECT_FALSE(last.hasVelocities);
}

TEST_F(LogReaderTest, OdometryComesBeforeTheObservationsOfItsFrame) {
  const ReadLog log = read(action(0, 1), frame(kStart_s));
  ASSERT_EQ(log.entries.size(), 3u);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kOdometry);
}

TEST_F(LogReaderTest, AnObservationWithoutStampTakesThatOfItsFrame) {
  const ReadLog log = read(frame(kStart_s));
  ASSERT_EQ(log.entries.size(), 2u);
  EXPECT_EQ(log.entries[0].label, "beacons");
  EXPECT_NEAR(log.entries[0].time_s, kStart_s, 1e-6);
}

TEST_F(LogReaderTest, ALastActionWithoutFrameKeepsItsOwnStamp) {
  const ReadLog log = read(frame(kStart_s), action(kStart_s + 1, 2));
  ASSERT_EQ(log.entries.size(), 3u);
  EXPECT_NEAR(log.entries[2].time_s, kStart_s + 1, 1e-6);
}

TEST_F(LogReaderTest, OneDamagedIncrementDoesNotSpoilTheRest) {
  const ReadLog log =
      read(action(0, 1), frame(kStart_s), action(0, kNan), frame(kStart_s + 1), action(0, 1), frame(kStart_s + 2));
  double x = 0;
  for (const Reading& e : log.entries)
    if (const auto* o = dynamic_cast<const mrpt::obs::CObservationOdometry*>(e.observation.get())) x = o->odometry.x();
  EXPECT_DOUBLE_EQ(x, 2);
}

TEST_F(LogReaderTest, OfTwoLabelsTheFirstServesUnlessOneIsTheKindsWord) {
  auto rear = gps(kStart_s), front = gps(kStart_s + 1), plain = gps(kStart_s + 2);
  rear.sensorLabel = "REAR";
  front.sensorLabel = "FRONT";
  const ReadLog log = read(rear, front, plain);
  ASSERT_EQ(log.entries.size(), 3u);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kGps);
  EXPECT_EQ(log.entries[1].kind, SensorKind::kOther);
  EXPECT_EQ(log.entries[2].kind, SensorKind::kGps);
}

TEST_F(LogReaderTest, AnOptionSaysWhichLabelServes) {
  auto rear = gps(kStart_s), front = gps(kStart_s + 1);
  rear.sensorLabel = "REAR";
  front.sensorLabel = "FRONT";
  options_.labels = {{"gps", "FRONT"}};
  const ReadLog log = read(rear, front);
  ASSERT_EQ(log.entries.size(), 2u);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kOther);
  EXPECT_EQ(log.entries[1].kind, SensorKind::kGps);
}

TEST_F(LogReaderTest, APoseMayBeNamedAsGps) {
  options_.labels = {{"gps", "gps_xy"}};
  const ReadLog log = read(pose(kStart_s, 1, "gps_xy"));
  ASSERT_EQ(log.entries.size(), 1u);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kGps);
}

TEST_F(LogReaderTest, PosesAreTruthEstimateOrNeither) {
  const ReadLog log = read(pose(kStart_s, 1, "GT"), pose(kStart_s + 1, 1, "estimate"), pose(kStart_s + 2, 1, "rtk"));
  ASSERT_EQ(log.entries.size(), 3u);
  EXPECT_EQ(log.entries[0].kind, SensorKind::kGroundTruth);
  EXPECT_EQ(log.entries[1].kind, SensorKind::kEstimate);
  EXPECT_EQ(log.entries[2].kind, SensorKind::kOther);
}

TEST_F(LogReaderTest, AMisspeltKindIsAnErrorThatSuggestsTheNearest) {
  writeLog(file_, 1);
  options_.labels = {{"odometri", "x"}};
  try {
    LogReader reader(file_, options_);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "label odometri=...: no such kind of sensor, did you mean odometry?");
  }
}

TEST_F(LogReaderTest, AMissingFileAndAFolderAreMissingInput) {
  for (const std::string& name : {folder_ / "none.rawlog", folder_ / ""}) {
    try {
      LogReader reader(name);
      FAIL() << name;
    } catch (const DatasetError& error) {
      EXPECT_EQ(error.code(), ExitCode::kInputMissing);
    }
  }
}

// Each row: what is refused, under which label and reason; an odometry after it must still come through.
TEST_F(LogReaderTest, RefusesWithTheReason) {
  const auto expectRefused = [&](const mrpt::obs::CObservation& bad, const std::string& reason) {
    const ReadLog log = read(bad, odometry(kStart_s + 1));
    EXPECT_EQ(log.entries.size(), 1u) << reason;
    ASSERT_TRUE(log.refused.contains(bad.sensorLabel)) << reason;
    EXPECT_EQ(log.refused.at(bad.sensorLabel).count(reason), 1u)
        << reason << ", got " << log.refused.at(bad.sensorLabel).begin()->first;
    EXPECT_FALSE(log.end.damaged);
  };
  auto unstamped = imu(kStart_s);
  unstamped.timestamp = INVALID_TIMESTAMP;
  expectRefused(unstamped, "no stamp");
  expectRefused(imu(0), "no stamp");
  expectRefused(imu(7e9), "future stamp");  // year 2191
  expectRefused(odometry(kStart_s, kNan), "not finite");
  expectRefused(odometry(kStart_s, 0, kNan), "not finite");
  expectRefused(odometry(kStart_s, 1e9), "absurd value");
  expectRefused(odometry(kStart_s, 0, 1e300), "absurd value");
  expectRefused(imu(kStart_s, kNan), "not finite");
  expectRefused(imu(kStart_s, 1e5), "absurd value");
  expectRefused(gps(kStart_s, kNan), "not finite");
  expectRefused(gps(kStart_s, 91), "absurd value");
  expectRefused(gps(kStart_s, 36, 0), "no fix");
  expectRefused(stamped<mrpt::obs::CObservationGPS>(kStart_s, "gps"), "no fix");
  expectRefused(scan(kStart_s, 0), "no beams");
  expectRefused(pose(kStart_s, 1e308), "bad covariance");
  expectRefused(pose(kStart_s, -1), "bad covariance");
  expectRefused(pose(kStart_s, kNan), "bad covariance");
  expectRefused(beacons(kStart_s, {0}), "only bad ranges");
}

TEST_F(LogReaderTest, AFlagThatIsNeitherTrueNorFalseCountsAsNotSet) {
  auto without = odometry(kStart_s);
  without.hasVelocities = false;
  const std::string with_flag = plainLog(odometry(kStart_s)), no_flag = plainLog(without);
  std::string garbage = with_flag;  // differs from the other in the flag first
  const auto flag = std::mismatch(with_flag.begin(), with_flag.end(), no_flag.begin()).first - with_flag.begin();
  garbage[static_cast<size_t>(flag)] = 74;
  store(file_, garbage);
  const ReadLog log = readLog(file_);
  ASSERT_EQ(log.entries.size(), 1u) << log.end.message;
  EXPECT_FALSE(dynamic_cast<const mrpt::obs::CObservationOdometry&>(*log.entries[0].observation).hasVelocities);
}

TEST_F(LogReaderTest, StampsNear1970AreLegal) {
  const ReadLog log = read(odometry(0.05), odometry(0.1));
  EXPECT_EQ(log.entries.size(), 2u);
}

TEST_F(LogReaderTest, RangesThatAreNoneAreTakenOutAlone) {
  const ReadLog log = read(beacons(kStart_s, {2, 0, std::numeric_limits<float>::infinity(), -3, 4}));
  ASSERT_EQ(log.entries.size(), 1u);
  const auto& kept = dynamic_cast<const mrpt::obs::CObservationBeaconRanges&>(*log.entries[0].observation);
  ASSERT_EQ(kept.sensedData.size(), 2u);
  EXPECT_EQ(kept.sensedData[1].beaconID, 5);
  EXPECT_EQ(log.refused.at("beacons").at("no range"), 3u);
}

TEST_F(LogReaderTest, BeamsThatAreNotFiniteBecomeInvalid) {
  auto laser = scan(kStart_s);
  laser.setScanRange(3, std::numeric_limits<float>::infinity());
  const ReadLog log = read(laser);
  ASSERT_EQ(log.entries.size(), 1u);
  const auto& kept = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*log.entries[0].observation);
  EXPECT_FALSE(kept.getScanRangeValidity(3));
  EXPECT_EQ(kept.getScanRange(3), 0);
}

TEST_F(LogReaderTest, SortsWithinTheWindowAndRefusesWhatComesLater) {
  const ReadLog log = read(odometry(kStart_s), odometry(kStart_s + 3), odometry(kStart_s + 1.5),
                           odometry(kStart_s + 10), odometry(kStart_s + 2));
  ASSERT_EQ(log.entries.size(), 4u);
  EXPECT_NEAR(log.entries[1].time_s, kStart_s + 1.5, 1e-6);
  EXPECT_NEAR(log.entries[2].time_s, kStart_s + 3, 1e-6);
  EXPECT_EQ(log.refused.at("odometry").at("backward stamp"), 1u);
}

TEST_F(LogReaderTest, EqualStampsKeepTheOrderOfTheLog) {
  const ReadLog log = read(odometry(kStart_s, 1), odometry(kStart_s, 2), odometry(kStart_s, 3));
  ASSERT_EQ(log.entries.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const auto& o = dynamic_cast<const mrpt::obs::CObservationOdometry&>(*log.entries[i].observation);
    EXPECT_DOUBLE_EQ(o.odometry.x(), static_cast<double>(i + 1));
  }
}

TEST_F(LogReaderTest, OneStrayStampAheadIsRefusedAndTheRestKept) {
  const ReadLog log =
      read(odometry(kStart_s), odometry(kStart_s + 1e6), odometry(kStart_s + 1), odometry(kStart_s + 2));
  EXPECT_EQ(log.entries.size(), 3u);
  EXPECT_EQ(log.refused.at("odometry").at("stray stamp"), 1u);
}

TEST_F(LogReaderTest, AClockThatJumpsAheadForGoodIsFollowed) {
  const ReadLog log = read(odometry(10), odometry(11), odometry(kStart_s), odometry(kStart_s + 1),
                           odometry(kStart_s + 2), odometry(kStart_s + 3));
  EXPECT_EQ(log.entries.size(), 6u);
  EXPECT_TRUE(log.refused.empty());
}

TEST_F(LogReaderTest, ReadsAWindowOfTheLog) {
  writeLog(file_, 20);
  options_.from_s = 0.5;
  options_.to_s = 1.0;
  const ReadLog log = readLog(file_, options_);
  ASSERT_FALSE(log.entries.empty());
  EXPECT_GE(log.entries.front().time_s, kStart_s + 0.5 - 1e-6);
  EXPECT_LE(log.entries.back().time_s, kStart_s + 1.0 + 1e-6);
}

TEST_F(LogReaderTest, NullObjectsAndForeignCommentsAreNoDamage) {
  mrpt::obs::CObservationComment comment;
  comment.text = "end: {n: 7}";
  store(file_, std::string("\x87nullptr\x88") + plainLog(comment, odometry(kStart_s)));
  const ReadLog log = readLog(file_);
  EXPECT_FALSE(log.end.damaged) << log.end.message;
  EXPECT_EQ(log.entries.size(), 1u);
  EXPECT_EQ(log.refused.at("null").at("null object"), 1u);
}

}  // namespace
}  // namespace sidestep
