// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <zlib.h>

#include <cmath>

#include "core/errors.h"
#include "support/damaged_logs.h"

namespace sidestep {
namespace {

using namespace worlds;

class LogDamageTest : public testing::Test {
 protected:
  ReadLog read(const std::string& bytes) {
    store(file_, bytes);
    return readLog(file_, options_);
  }
  std::string ours(int steps) {
    writeLog(file_, steps);
    return contents(file_);
  }
  TemporaryFolder folder_;
  std::string file_ = folder_ / "log.rawlog";
  LogReaderOptions options_;
};

TEST_F(LogDamageTest, EveryCutOfOurLogsIsReported) {
  const std::string whole = ours(3);
  for (size_t n = 0; n < whole.size(); n += 5) {
    const ReadLog log = read(whole.substr(0, n));
    EXPECT_TRUE(log.end.damaged) << n;
    EXPECT_FALSE(log.end.message.empty()) << n;
    EXPECT_LE(log.entries.size(), 15u);
  }
}

TEST_F(LogDamageTest, EveryCutInsideAnEntryOfAPlainLogIsReported) {
  const std::string first = plainLog(odometry(kStart_s)), whole = first + plainLog(imu(kStart_s + 1));
  for (size_t n = 2; n < whole.size(); n += 3) EXPECT_TRUE(read(whole.substr(0, n)).end.damaged) << n;
  EXPECT_FALSE(read(first).end.damaged);  // which nobody can tell from a whole log
}

TEST_F(LogDamageTest, WhatCameBeforeTheCutIsKept) {
  const std::string first = plainLog(odometry(kStart_s));
  const ReadLog log = read(first + plainLog(imu(kStart_s + 1)).substr(0, 30));
  EXPECT_EQ(log.entries.size(), 1u);
  EXPECT_EQ(log.end.message, file_ + ": damaged at entry 1, byte " + std::to_string(first.size()) +
                                 ": the last entry is cut short; what came before is kept");
}

TEST_F(LogDamageTest, AFlippedByteOfACompressedLogIsReportedUnlessNothingChanged) {
  const std::string whole = ours(3);
  for (size_t i = 0; i < whole.size(); i += 7) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    const ReadLog log = read(flipped);
    EXPECT_TRUE(log.end.damaged || log.entries.size() == 15) << i;
  }
}

TEST_F(LogDamageTest, NothingThatIsNotFiniteComesOutOfFlippedPlainLogs) {
  const std::string whole = plainLog(odometry(kStart_s, 1, 1), odometry(kStart_s + 1, 2, 1));
  for (size_t i = 0; i < whole.size(); i += 2) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x7f);
    for (const Reading& entry : read(flipped).entries) {
      const auto* o = dynamic_cast<const mrpt::obs::CObservationOdometry*>(entry.observation.get());
      EXPECT_TRUE(o == nullptr || std::isfinite(o->odometry.x() + o->odometry.y() + o->odometry.phi())) << i;
    }
  }
}

TEST_F(LogDamageTest, AHostileLengthEndsTheLogInBoundedMemory) {
  options_.memory_limit_bytes = 64 << 20;
  const ReadLog log = read(plainLog(odometry(kStart_s)) + hostileScan());
  EXPECT_EQ(log.entries.size(), 1u);  // sent before decoding killed the child
  EXPECT_NE(log.end.message.find("damaged at entry 1"), std::string::npos) << log.end.message;
  EXPECT_NE(log.end.message.find("64 MiB"), std::string::npos) << log.end.message;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    EXPECT_LT(usage.ru_maxrss, 1 << 20);  // KiB; the scan asks for 16 GiB
  }
}

TEST_F(LogDamageTest, AnEntryThatTakesTooLongEndsTheLog) {
  options_.seconds_per_entry = 0.004;
  const auto log = read(plainLog(odometry(kStart_s), scan(kStart_s + 1, 20'000'000)));  // 100 MB
  EXPECT_EQ(log.entries.size(), 1u);
  EXPECT_NE(log.end.message.find("takes more than 0.004"), std::string::npos) << log.end.message;
}

TEST_F(LogDamageTest, FilesThatAreNoRawlogsAreNamedSo) {
  const std::string nothing("\x1f\x8b\x08\0\0\0\0\0\0\x03\x03\0\0\0\0\0\0\0\0\0", 20);
  for (const std::string& bytes : {std::string(), nothing, std::string("Dear reader,\nthis is a letter.\n")}) {
    const ReadLog log = read(bytes);
    EXPECT_TRUE(log.end.damaged);
    EXPECT_TRUE(log.entries.empty());
    EXPECT_NE(log.end.message.find("not a rawlog"), std::string::npos) << log.end.message;
  }
}

TEST_F(LogDamageTest, AnUnknownClassIsNamed) {
  std::string bytes = plainLog(odometry(kStart_s), odometry(kStart_s + 1));
  bytes.replace(bytes.rfind("Odometry"), 8, "Odometer");
  EXPECT_NE(read(bytes).end.message.find("CObservationOdometer"), std::string::npos);
}

TEST_F(LogDamageTest, AnEndMarkerThatContradictsIsReported) {
  LogWriter log(file_, "");
  log.write(odometry(kStart_s));
  log.close();
  gzFile in = gzopen(file_.c_str(), "rb");
  std::string plain(4096, '\0');
  plain.resize(static_cast<size_t>(gzread(in, plain.data(), 4096)));
  gzclose(in);
  plain.replace(plain.find("{n: 1}"), 6, "{n: 2}");
  EXPECT_NE(read(plain).end.message.find("the end marker says 2 entries, there are 1"), std::string::npos);
}

TEST_F(LogDamageTest, AReaderMayBeDroppedInTheMiddle) {
  ours(2000);
  LogReader reader(file_);
  EXPECT_TRUE(reader.next().has_value());
  EXPECT_FALSE(reader.end().damaged);
}

}  // namespace
}  // namespace sidestep
