// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/metrics_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/errors.h"

namespace sidestep {
namespace {

LocalizationMetrics example() {
  LocalizationMetrics metrics;
  metrics.duration_s = 12.5;
  metrics.truth_source = "log";
  TrajectoryErrors errors;
  errors.samples = errors.heading_samples = 3;
  errors.mean_error_m = 0.25;
  errors.mean_nees = 2.5;
  errors.alignment = Alignment::kLeastSquares;
  errors.T_truth_estimate = {1, 2, std::numbers::pi / 2};
  metrics.estimate = errors;
  errors.heading_samples = 0;
  errors.mean_nees.reset();
  errors.max_error_m = std::numeric_limits<double>::infinity();
  metrics.odometry = errors;
  metrics.sensors["gps"] = {10, 8, {{"outlier", 2}}, 1.5, 2, {}};
  metrics.sensors["imu"].read = 4;
  return metrics;
}

TEST(MetricsJson, HasItsKeysInOrder) {
  const auto json = nlohmann::ordered_json::parse(metricsJson(example()));
  std::string keys;
  for (const auto& item : json.items()) keys += item.key() + " ";
  EXPECT_EQ(keys, "duration_s wall_s peak_memory_mb truth_source estimate odometry sensors partial warnings ");
  keys.clear();
  for (const auto& item : json["estimate"].items()) keys += item.key() + " ";
  EXPECT_EQ(keys,
            "mean_error_m mean_square_error_m2 rmse_m max_error_m final_error_m heading_mean_error_deg samples "
            "alignment T_truth_estimate mean_nees nees_dof nees_independent verdict ");
}

TEST(MetricsJson, SaysWhatWasMeasured) {
  const auto json = nlohmann::json::parse(metricsJson(example()));
  EXPECT_EQ(json["duration_s"], 12.5);
  EXPECT_EQ(json["estimate"]["alignment"], "se2");
  EXPECT_EQ(json["estimate"]["mean_nees"], 2.5);
  EXPECT_EQ(json["estimate"]["T_truth_estimate"]["yaw_deg"], 90.0);
  EXPECT_EQ(json["sensors"]["gps"]["refused"]["outlier"], 2);
  EXPECT_EQ(json["sensors"]["gps"]["mean_nis"], 1.5);
  EXPECT_EQ(json["sensors"]["gps"]["nis_dof"], 2);
  EXPECT_EQ(json["partial"], false);
}

TEST(MetricsJson, HasNullForWhatIsNotKnown) {
  const auto json = nlohmann::json::parse(metricsJson(example()));
  EXPECT_TRUE(json["odometry"]["max_error_m"].is_null());
  EXPECT_FALSE(json["odometry"].contains("heading_mean_error_deg"));
  EXPECT_FALSE(json["odometry"].contains("mean_nees"));
  EXPECT_TRUE(json["sensors"]["imu"]["mean_nis"].is_null());
  EXPECT_EQ(json["sensors"]["imu"]["refused"], nlohmann::json::object());
}

TEST(MetricsJson, HasEmptyErrorsWithoutTruth) {
  const auto json = nlohmann::json::parse(metricsJson({}));
  EXPECT_EQ(json["estimate"], nlohmann::json::object());
  EXPECT_EQ(json["odometry"], nlohmann::json::object());
  EXPECT_EQ(json["sensors"], nlohmann::json::object());
  EXPECT_EQ(json["warnings"], nlohmann::json::array());
}

TEST(MetricsJson, NoticesAFullDisk) { EXPECT_THROW(writeMetrics({}, "/dev/full"), DatasetError); }

TEST(ErrorTable, HasARowForEachTrajectory) {
  EXPECT_EQ(
      errorTable(example()),
      "            mean error [m]        rmse [m]         max [m]       final [m]   heading [deg]            NEES\n"
      "odometry             0.250           0.000               -           0.000               -               -\n"
      "estimate             0.250           0.000           0.000           0.000            0.00            2.50\n");
}

TEST(PeakMemory, IsThatOfThisProcess) {
  EXPECT_GT(peakMemoryMb(), 1);
  EXPECT_LT(peakMemoryMb(), 1e6);
}

}  // namespace
}  // namespace sidestep
