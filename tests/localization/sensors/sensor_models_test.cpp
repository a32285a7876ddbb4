// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationIMU.h>

#include <limits>

#include "localization/sensors/beacons.h"
#include "localization/sensors/gps.h"
#include "localization/sensors/imu.h"
#include "localization/sensors/sensors.h"
#include "support/readings.h"

namespace sidestep {
namespace {

using support::fixAt;
using support::imuWith;
using support::kStart_s;
using namespace mrpt::obs;
constexpr double kDegree = M_PI / 180;

// ---- GPS ----

TEST(GpsModel, PutsFixesIntoMetersEastAndNorthOfTheDatum) {
  GpsParams params;
  params.datum_given = true;
  params.datum_lat_deg = 45;
  params.datum_lon_deg = 9;
  GpsModel gps(params);
  // WGS84 at 45 deg: one degree of latitude is 111132 m, one of longitude 78847 m.
  const auto north = gps.measurement(kStart_s, fixAt(45 + 1e-5, 9));
  EXPECT_NEAR(north->z.x(), 0, 1e-6);
  EXPECT_NEAR(north->z.y(), 1.11132, 1e-4);
  const auto east = gps.measurement(kStart_s, fixAt(45, 9 + 1e-5));
  EXPECT_NEAR(east->z.x(), 0.78847, 1e-4);
  EXPECT_NEAR(east->z.y(), 0, 1e-6);
}

TEST(GpsModel, TakesTheFirstFixAsDatum) {
  GpsModel gps({});
  EXPECT_FALSE(gps.hasDatum());
  const auto first = gps.measurement(kStart_s, fixAt(45, 9));
  EXPECT_TRUE(gps.hasDatum());
  EXPECT_NEAR(first->z.norm(), 0, 1e-6);
  EXPECT_NEAR(gps.measurement(kStart_s + 1, fixAt(45 + 1e-5, 9))->z.y(), 1.11132, 1e-4);
}

TEST(GpsModel, TellsNothingWithoutAFix) {
  GpsModel gps({});
  EXPECT_FALSE(gps.measurement(kStart_s, CObservationGPS()));
  EXPECT_FALSE(gps.measurement(kStart_s, fixAt(std::numeric_limits<double>::quiet_NaN(), 9)));
  EXPECT_FALSE(gps.hasDatum());  // a datum that is no number would spoil all that follows
}

TEST(GpsModel, TakesTheAntennasPlaceFromTheLogOrTheParameters) {
  auto o = fixAt(45, 9);
  o.sensorPose = mrpt::poses::CPose3D(0.5, -0.2, 1.8, 0, 0, 0);
  GpsParams params;
  params.lever_x_m = 1;
  EXPECT_EQ(GpsModel(params).measurement(kStart_s, o)->p_base_sensor, Eigen::Vector3d(0.5, -0.2, 0));
  params.lever_from_log = false;
  EXPECT_EQ(GpsModel(params).measurement(kStart_s, o)->p_base_sensor, Eigen::Vector3d(1, 0, 0));
}

TEST(GpsModel, GoesByTheFixsOwnQualityWhenAsked) {
  GpsParams params;
  params.sd_m = 3;
  params.use_hdop = 2;
  GpsModel gps(params);
  EXPECT_NEAR(gps.measurement(kStart_s, fixAt(45, 9, 1.5))->R(0, 0), 9, 1e-12);     // 2 * 1.5
  EXPECT_NEAR(gps.measurement(kStart_s + 1, fixAt(45, 9, 4))->R(1, 1), 64, 1e-12);  // 2 * 4
  EXPECT_NEAR(gps.measurement(kStart_s + 2, fixAt(45, 9))->R(1, 1), 9, 1e-12);      // none: sd_m
}

TEST(GpsModel, RaisesTheNoiseOfFixesWhoseErrorsAreAlike) {
  GpsParams params;
  params.sd_m = 1;
  params.correlation_s = 10;
  GpsModel gps(params);
  EXPECT_NEAR(gps.measurement(kStart_s, 0, 0).R(0, 0), 1, 1e-12);  // the first stands alone
  EXPECT_NEAR(gps.measurement(kStart_s + 0.5, 0, 0).R(0, 0), 2 * 10 / 0.5, 1e-4);
  EXPECT_NEAR(gps.measurement(kStart_s + 2.5, 0, 0).R(0, 0), 2 * 10 / 2.0, 1e-4);
  EXPECT_NEAR(gps.measurement(kStart_s + 100, 0, 0).R(0, 0), 1, 1e-12);  // 2 tau / dt < 1: never better than one fix
}

TEST(GpsModel, PutsDelayedFixesBackWhereTheyBelong) {
  GpsParams params;
  params.delay_s = 0.25;
  GpsModel gps(params);
  EXPECT_EQ(gps.measurement(kStart_s, fixAt(45, 9))->time_s, kStart_s - 0.25);
  EXPECT_EQ(gps.measurement(kStart_s, 1, 2).time_s, kStart_s - 0.25);
}

// ---- IMU ----

CObservationIMU mounted(CObservationIMU o, double yaw_deg, double pitch_deg, double roll_deg) {
  o.sensorPose = mrpt::poses::CPose3D(0, 0, 0, yaw_deg * kDegree, pitch_deg * kDegree, roll_deg * kDegree);
  return o;
}

TEST(ReadImu, TakesTheYawRateOfALevelSensorAsItIs) {
  EXPECT_NEAR(*readImu({}, mounted(support::yawRate(0.3), 77, 0, 0)).yaw_rate, 0.3, 1e-12);
}

TEST(ReadImu, TurnsTheRateOfASensorThatHangsUpsideDown) {
  EXPECT_NEAR(*readImu({}, mounted(support::yawRate(0.3), 0, 0, 180)).yaw_rate, -0.3, 1e-12);
}

TEST(ReadImu, FindsTheRobotsTurnInTheRatesOfASensorOnItsSide) {
  // Yaw -90, roll 90: the base's z axis is the sensor's y axis (third row of Rz(-90) Rx(90) is (0, 1, 0)).
  const auto imu = mounted(imuWith({{IMU_WX, 7}, {IMU_WY, 0.4}, {IMU_WZ, -9}}), -90, 0, 90);
  EXPECT_NEAR(*readImu({}, imu).yaw_rate, 0.4, 1e-12);
}

TEST(ReadImu, CorrectsRatesByBiasAndScale) {
  ImuParams params;
  params.yaw_rate_bias = 0.1;
  params.yaw_rate_scale = 2;
  EXPECT_NEAR(*readImu(params, support::yawRate(0.4)).yaw_rate, 0.6, 1e-12);
}

TEST(ReadImu, FindsTheRobotsHeadingThroughATiltedMount) {
  // Whatever the mount: the sensor's attitude is the robot's times the mount, and the robot is level at 40 deg.
  for (const auto& [yaw, pitch, roll] : {std::tuple{0, 0, 0}, {90, 0, 0}, {30, 20, 0}, {-90, 0, 90}, {0, 0, 180}}) {
    const mrpt::poses::CPose3D mount(0, 0, 0, yaw * kDegree, pitch * kDegree, roll * kDegree);
    const auto attitude = mrpt::poses::CPose3D(0, 0, 0, 40 * kDegree, 0, 0) + mount;
    auto o = imuWith({{IMU_YAW, attitude.yaw()}, {IMU_PITCH, attitude.pitch()}, {IMU_ROLL, attitude.roll()}});
    o.sensorPose = mount;
    EXPECT_NEAR(*readImu({}, o).heading_rad, 40 * kDegree, 1e-9) << yaw << " " << pitch << " " << roll;
  }
}

TEST(ReadImu, SubtractsTheHeadingOffsetAndWraps) {
  ImuParams params;
  params.heading_offset = -20 * kDegree;
  EXPECT_NEAR(*readImu(params, support::yaw(170 * kDegree)).heading_rad, -170 * kDegree, 1e-12);
}

TEST(ReadImu, TellsOnlyWhatIsThereAndWanted) {
  const auto both = imuWith({{IMU_YAW, 1}, {IMU_WZ, 2}});
  EXPECT_FALSE(readImu({}, support::yaw(1)).yaw_rate);
  EXPECT_FALSE(readImu({}, support::yawRate(1)).heading_rad);
  ImuParams params;
  params.heading = "off";
  EXPECT_FALSE(readImu(params, both).heading_rad);
  EXPECT_TRUE(readImu(params, both).yaw_rate);
  params.yaw_rate = "off";
  EXPECT_FALSE(readImu(params, both).yaw_rate);
}

TEST(HeadingMeasurement, CarriesNoiseAndDelay) {
  ImuParams params;
  params.heading_sd = 0.2;
  params.delay_s = 0.5;
  const auto m = headingMeasurement(params, kStart_s, 1, 0.1);
  EXPECT_EQ(m.time_s, kStart_s - 0.5);
  EXPECT_EQ(m.z(0), 1);
  EXPECT_NEAR(m.R(0, 0), 0.04, 1e-15);
  EXPECT_TRUE(m.heading_has_offset);
}

// ---- beacons ----

TEST(BeaconMeasurements, TellOfKnownBeaconsOnly) {
  BeaconParams params;
  params.beacons = {{7, 1, 2, 3}};
  params.sd_m = 0.3;
  params.delay_s = 0.1;
  CObservationBeaconRanges o;
  for (int id : {7, 8}) {
    CObservationBeaconRanges::TMeasurement range;
    range.beaconID = id;
    range.sensedDistance = 4.5f;
    range.sensorLocationOnRobot = mrpt::poses::CPoint3D(0.1, 0.2, 0.3);
    o.sensedData.push_back(range);
  }
  SensorSays says;
  makeBeaconSensor(params)->interpret(support::readingOf(SensorKind::kBeacons, kStart_s, o), says);
  EXPECT_EQ(says.read, 1u);
  const auto& found = says.measurements;
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, Measurement::Kind::kRange);
  EXPECT_EQ(found[0].z(0), 4.5);
  EXPECT_NEAR(found[0].R(0, 0), 0.09, 1e-15);
  EXPECT_EQ(found[0].time_s, kStart_s - 0.1);
  EXPECT_EQ(found[0].p_map_beacon, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(found[0].p_base_sensor, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(BeaconMeasurements, SaySoWhereNoBeaconIsKnown) {
  CObservationBeaconRanges o;
  o.sensedData.resize(1);
  SensorSays says;
  makeBeaconSensor({})->interpret(support::readingOf(SensorKind::kBeacons, kStart_s, o), says);
  EXPECT_TRUE(says.measurements.empty());
  EXPECT_STREQ(says.refused, "unknown_beacon");
}

// ---- the table ----

TEST(Sensors, EachRowHasWordsParametersAndAModel) {
  const auto params = sensorParams();
  for (const auto& row : sensors()) {
    EXPECT_EQ(sensorOf(row.kind), &row);
    EXPECT_STRNE(row.about, "") << word(row.kind);
    EXPECT_STREQ(row.section->key, word(row.kind).c_str());
    EXPECT_NE(row.make(params), nullptr) << word(row.kind);
  }
  EXPECT_EQ(sensorOf(SensorKind::kOther), nullptr);
}

/// An observation that is not of the sensor's class is refused by name, never believed.
TEST(Sensors, EachModelRefusesWhatItCannotRead) {
  const auto params = sensorParams();
  for (const auto& row : sensors()) {
    Reading reading{kStart_s, row.kind, "strange", std::make_shared<CObservationComment>()};
    SensorSays says;
    row.make(params)->interpret(reading, says);
    EXPECT_TRUE(says.measurements.empty() && !says.wheels && !says.yaw_rate) << word(row.kind);
    ASSERT_NE(says.refused, nullptr) << word(row.kind);
    EXPECT_STRNE(says.refused, "") << word(row.kind);
  }
}

}  // namespace
}  // namespace sidestep
