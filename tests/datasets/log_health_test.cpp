// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_health.h"

#include <gtest/gtest.h>

#include "datasets/log_histogram.h"
#include "support/log_worlds.h"

namespace sidestep {
namespace {

using namespace worlds;

class LogHealthTest : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string file_ = folder_ / "log.rawlog";
};

TEST_F(LogHealthTest, AGoodLogIsHealthyAndItsRatesAreRight) {
  writeLog(file_, 101);  // 10 s at 10 Hz
  const LogHealth health = examineLog(file_, {});
  EXPECT_EQ(health.verdict, Verdict::kHealthy);
  EXPECT_TRUE(health.reasons.empty());
  EXPECT_EQ(health.format, "gzip, observations");
  ASSERT_EQ(health.labels.size(), 5u);
  const LabelHealth& h = health.labels.at("odometry");
  EXPECT_EQ(h.class_name, "CObservationOdometry");
  EXPECT_EQ(h.count, 101u);
  EXPECT_NEAR(h.rate_hz, 10, 1e-6);
  EXPECT_NEAR(h.period_s, 0.1, 1e-5);
  EXPECT_LT(h.jitter_s, 0.005);
  EXPECT_EQ(h.gaps, 0u);
}

TEST_F(LogHealthTest, GapsAreCountedAndTheLargestIsPlaced) {
  LogWriter log(file_, "");
  for (int i = 0; i < 50; ++i) log.write(odometry(kStart_s + 0.1 * i + (i >= 30 ? 7 : 0)));
  log.close();
  const LogHealth health = examineLog(file_, {});
  EXPECT_EQ(health.verdict, Verdict::kUsableWithCare);
  const LabelHealth& h = health.labels.at("odometry");
  EXPECT_EQ(h.gaps, 1u);
  EXPECT_NEAR(h.largest_gap_s, 7.1, 1e-6);
  EXPECT_NEAR(h.largest_gap_at_s, kStart_s + 2.9, 1e-6);
}

TEST_F(LogHealthTest, WhatWasRefusedIsAReasonForCare) {
  LogWriter log(file_, "");
  log.write(odometry(kStart_s));
  log.write(scan(kStart_s, 0));
  log.close();
  const LogHealth health = examineLog(file_, {});
  EXPECT_EQ(health.verdict, Verdict::kUsableWithCare);
  EXPECT_EQ(health.reasons, std::vector<std::string>{"laser: 1 refused, no beams"});
}

TEST_F(LogHealthTest, ACutLogIsDamaged) {
  { LogWriter(file_, "").write(odometry(kStart_s)); }
  const LogHealth health = examineLog(file_, {});
  EXPECT_EQ(health.verdict, Verdict::kDamaged);
  EXPECT_NE(health.reasons.front().find("cut short"), std::string::npos);
}

TEST(LogHistogramTest, QuantilesAreWithinABin) {
  LogHistogram h;
  for (int i = 1; i <= 1000; ++i) h.add(0.001 * i);
  EXPECT_NEAR(h.quantile(0.5), 0.5, 0.03);
  EXPECT_NEAR(h.quantile(0.95), 0.95, 0.05);
  EXPECT_NEAR(static_cast<double>(h.countAbove(0.5)), 500, 30);
}

}  // namespace
}  // namespace sidestep
