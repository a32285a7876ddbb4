// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_writer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>

#include "core/errors.h"
#include "support/log_worlds.h"

namespace sidestep {
namespace {

using namespace worlds;

TEST(LogWriterTest, ALogWithoutObservationsIsWhole) {
  TemporaryFolder folder;
  LogWriter(folder / "log.rawlog", "").close();
  EXPECT_FALSE(readLog(folder / "log.rawlog").end.damaged);
}

TEST(LogWriterTest, TheSameObservationsGiveTheSameBytes) {
  TemporaryFolder folder;
  writeLog(folder / "a.rawlog");
  writeLog(folder / "b.rawlog");
  EXPECT_TRUE(contents(folder / "a.rawlog") == contents(folder / "b.rawlog"));
}

TEST(LogWriterTest, WithoutCloseTheLogCountsAsCutShort) {
  TemporaryFolder folder;
  { LogWriter(folder / "log.rawlog", "").write(odometry(kStart_s)); }
  const ReadLog log = readLog(folder / "log.rawlog");
  EXPECT_EQ(log.entries.size(), 1u);
  EXPECT_TRUE(log.end.damaged);
  EXPECT_NE(log.end.message.find("cut short: no end marker"), std::string::npos) << log.end.message;
}

TEST(LogWriterTest, WhatAKilledProgramWroteCanBeReadButForTheLastSecond) {
  TemporaryFolder folder;
  const std::string file = folder / "log.rawlog";
  const pid_t child = fork();
  if (child == 0) {
    LogWriter log(file, "");
    for (int i = 0; i <= 100; ++i) log.write(odometry(kStart_s + 0.1 * i));
    raise(SIGKILL);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const ReadLog log = readLog(file);
  EXPECT_GE(log.entries.size(), 90u);  // 101 written, 10 a second
  EXPECT_TRUE(log.end.damaged);
}

TEST(LogWriterTest, AFullDiskIsReported) {
  const auto fill = [] {
    LogWriter log("/dev/full", "");
    log.write(odometry(kStart_s));
    log.close();
  };
  try {
    fill();
    FAIL();
  } catch (const DatasetError& error) {
    EXPECT_STREQ(error.what(), "/dev/full: cannot be written: No space left on device");
  }
}

TEST(LogWriterTest, AFolderThatIsNotThereIsReported) {
  EXPECT_THROW(LogWriter("/nonexistent/log.rawlog", ""), DatasetError);
}

}  // namespace
}  // namespace sidestep
