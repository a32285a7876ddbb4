// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What a drive with known noise says of a filter that believes in that noise, and of one that does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/random.h"
#include "evaluation/experiments/drive.h"
#include "evaluation/metrics/drive_metrics.h"
#include "localization/filters/ekf.h"
#include "localization/filters/particle_filter.h"
#include "localization/sensors/gps.h"
#include "localization/sensors/imu.h"
#include "localization/sensors/odometry.h"

namespace sidestep {
namespace {

/// Wheels, IMU headings and fixes with white noise, on a winding way of 30 s.
LocalizationScenario windingDrive() {
  LocalizationScenarioParams p;
  p.trajectory.kind = "sinusoid";
  p.trajectory.duration_s = 30;
  p.trajectory.step_s = 0.05;
  p.trajectory.v = 1;
  p.trajectory.w_amplitude = 0.4;
  p.trajectory.w_frequency = 0.5;
  p.encoders.v_sd = 0.2;
  p.encoders.w_sd = 0.4;
  p.imu.rate_hz = 5;
  p.imu.heading_sd = 0.1;
  p.gps.rate_hz = 4;
  p.gps.sd_m = 0.5;
  return LocalizationScenario(p);
}

LocalizeConfig matched(const LocalizationScenario& drive, const std::string& filter) {
  LocalizeConfig c;
  c.filter = filter;
  c.align = "none";
  auto& r = c.robot;
  r.start.pose_given = true;
  r.start.x_m = drive.params().trajectory.x_m;
  r.start.y_m = drive.params().trajectory.y_m;
  r.start.yaw = drive.params().trajectory.yaw;
  r.start.position_sd_m = 0.01;
  r.start.yaw_sd = 0.01;
  r.of<OdometryParams>().noise = {
      .a1 = 0.2, .a2 = 0, .a3 = 0, .a4 = 0, .a5 = 0, .a6 = 0, .noise_period_s = 0, .turn_floor = 0.4};
  r.of<ImuParams>().yaw_rate = "off";
  r.of<ImuParams>().heading_sd = 0.1;
  r.of<GpsParams>().sd_m = 0.5;
  c.filters.of<EkfParams>().heading_offset_sd = c.filters.of<PfParams>().heading_offset_sd = 0;
  return c;
}

using MeanMetrics = std::map<std::string, double>;

MeanMetrics meanOverRuns(const LocalizationScenario& drive, const LocalizeConfig& config, int runs) {
  MeanMetrics out;
  for (int run = 0; run < runs; ++run) {
    const auto seed = static_cast<uint64_t>(run);
    const auto numbers = measureDrive(localizeSimulated(drive, config, {}, seed, seed + 1000), {}, {}, 0);
    for (const auto& row : driveMetrics()) out[row.info.name] += row.value(numbers) / runs;
  }
  return out;
}

TEST(FilterConsistency, MatchedNoisePassesAtNinetyFivePercent) {
  // 100 runs: 95 of them, standard error 2.2; a filter that linearizes, or has 500 particles, may be a little worse.
  const auto drive = windingDrive();
  for (const char* filter : {"ekf", "pf"}) {
    const auto m = meanOverRuns(drive, matched(drive, filter), 100);
    EXPECT_NEAR(m.at("nees"), 1, 0.12) << filter;
    EXPECT_GE(m.at("nees_in_band"), 0.88) << filter;
    EXPECT_NEAR(m.at("nis_gps"), 1, 0.05) << filter;
    EXPECT_GE(m.at("nis_gps_in_band"), 0.88) << filter;
    EXPECT_NEAR(m.at("nis_imu"), 1, 0.05) << filter;
    EXPECT_GE(m.at("nis_imu_in_band"), 0.88) << filter;
  }
}

TEST(FilterConsistency, SmoothedErrorsPassToo) {
  const auto drive = windingDrive();
  auto config = matched(drive, "ekf");
  config.smooth = true;
  const auto m = meanOverRuns(drive, config, 60);
  EXPECT_NEAR(m.at("nees"), 1, 0.15);
  EXPECT_GE(m.at("nees_in_band"), 0.85);
}

/// The factor that judgeSensor gives for all runs together.
double factorOf(const LocalizationScenario& drive, const LocalizeConfig& config, const std::string& kind,
                std::string* verdict) {
  double sum = 0, count = 0;
  int dof = 0;
  for (uint64_t run = 0; run < 20; ++run)
    for (const auto& k : localizeSimulated(drive, config, {}, run, run).nis)
      if (k.kind == kind) {
        sum += k.sum;
        count += k.count;
        dof = k.dof;
      }
  const auto c = judgeSensor(sum / count, count, count, dof, *config.gateProbability());
  *verdict = c.verdict;
  return c.sd_factor;
}

TEST(FilterConsistency, ASensorThatIsThreeTimesWrongIsNamedAndNoOther) {
  const auto drive = windingDrive();
  for (const char* filter : {"ekf", "pf"}) {
    for (const bool too_small : {true, false}) {
      auto config = matched(drive, filter);
      config.robot.of<GpsParams>().sd_m = too_small ? 0.5 / 3 : 0.5 * 3;
      std::string gps, imu;
      const double factor = factorOf(drive, config, "gps", &gps), other = factorOf(drive, config, "imu", &imu);
      EXPECT_EQ(gps, too_small ? "over-confident" : "too cautious") << filter;
      EXPECT_NEAR(too_small ? factor : 1 / factor, 3, 0.9) << filter;
      EXPECT_NEAR(other, 1, 0.15) << filter << " imu " << imu;
    }
  }
}

}  // namespace
}  // namespace sidestep
