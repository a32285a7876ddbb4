// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_recovery.h"

#include <gtest/gtest.h>

#include "support/log_worlds.h"

namespace sidestep {
namespace {

using namespace worlds;

class LogRecoveryTest : public testing::Test {
 protected:
  RecoveryReport recover(const std::string& bytes) {
    store(in_, bytes);
    return recoverLog(in_, out_);
  }
  TemporaryFolder folder_;
  std::string in_ = folder_ / "in.rawlog", out_ = folder_ / "out.rawlog";
};

TEST_F(LogRecoveryTest, AWholeLogIsCopied) {
  writeLog(in_, 30);
  const RecoveryReport report = recover(contents(in_));
  EXPECT_EQ(report.entries, 150u);
  EXPECT_EQ(report.breaks, 0u);
  EXPECT_EQ(report.lost_bytes + report.skipped_bytes, 0u);
  EXPECT_TRUE(contents(in_).size() > 0 && readLog(out_).entries.size() == 150);
  EXPECT_FALSE(readLog(out_).end.damaged);
}

TEST_F(LogRecoveryTest, DamageInTheMiddleOfACompressedLogCostsAboutASecond) {
  writeLog(in_, 100);  // 10 s, 50 entries a second
  std::string bytes = contents(in_);
  for (size_t i = 0; i < 40; ++i) bytes[bytes.size() / 2 + i] = static_cast<char>(bytes[bytes.size() / 2 + i] ^ 0x5a);
  const RecoveryReport report = recover(bytes);
  EXPECT_GE(report.breaks, 1u);
  EXPECT_GE(report.entries, 390u);
  const ReadLog log = readLog(out_);
  EXPECT_FALSE(log.end.damaged) << log.end.message;
  EXPECT_NEAR(log.entries.back().time_s, kStart_s + 9.94, 1e-6);
}

TEST_F(LogRecoveryTest, DamageInTheMiddleOfAPlainLogCostsOneEntry) {
  const std::string a = plainLog(odometry(kStart_s)), b = plainLog(scan(kStart_s + 1)), c = plainLog(imu(kStart_s + 2));
  std::string damaged = b;
  damaged.replace(damaged.find("RangeScan"), 9, "RangeScum");
  const RecoveryReport report = recover(a + damaged + c);
  EXPECT_EQ(report.entries, 2u);
  EXPECT_EQ(report.lost_bytes, b.size());
  EXPECT_EQ(report.breaks, 1u);
  EXPECT_EQ(readLog(out_).entries.size(), 2u);
}

TEST_F(LogRecoveryTest, ACutLogIsClosed) {
  writeLog(in_, 30);
  const std::string whole = contents(in_);
  const RecoveryReport report = recover(whole.substr(0, whole.size() * 2 / 3));
  EXPECT_GT(report.entries, 50u);
  EXPECT_EQ(readLog(out_).entries.size(), report.entries);
  EXPECT_FALSE(readLog(out_).end.damaged);
}

TEST_F(LogRecoveryTest, FilesThatHoldNothingGiveAnEmptyLog) {
  for (const std::string& bytes : {std::string(), std::string("letters"), std::string("\x1f\x8b")}) {
    EXPECT_EQ(recover(bytes).entries, 0u);
    EXPECT_FALSE(readLog(out_).end.damaged);
  }
}

TEST_F(LogRecoveryTest, NoWorkingFileIsLeft) {
  writeLog(in_, 3);
  recoverLog(in_, out_);
  EXPECT_FALSE(std::filesystem::exists(out_ + ".plain"));
}

}  // namespace
}  // namespace sidestep
