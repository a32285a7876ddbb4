// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <limits>
#include <map>
#include <string>

#include "support/log_worlds.h"

namespace sidestep::worlds {

/// A scan whose count of beams says 0xFFFFFFFF.
inline std::string hostileScan() {
  std::string bytes = bytesFromObject(scan(kStart_s + 1, 1234));
  const size_t at = bytes.find(std::string("\xd2\x04\0\0", 4));  // 1234
  return bytes.replace(at, 4, "\xff\xff\xff\xff");
}

inline std::string frameLog() {
  std::string out;
  for (int i = 0; i < 3; ++i) {
    mrpt::obs::CActionRobotMovement2D move;
    move.rawOdometryIncrementReading = mrpt::poses::CPose2D(0.1, 0, 0);
    mrpt::obs::CActionCollection actions;
    actions.insert(move);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(std::make_shared<mrpt::obs::CObservation2DRangeScan>(scan(kStart_s + i)));
    frame.insert(std::make_shared<mrpt::obs::CObservationBeaconRanges>(beacons(kStart_s + i, {2, 3})));
    out += plainLog(actions, frame);
  }
  return out;
}

inline std::string otherClasses() {
  auto seen = stamped<mrpt::obs::CObservationBearingRange>(kStart_s, "landmarks");
  seen.sensedData.resize(2);
  seen.sensedData[0] = {2.f, 0.1f, 0.f, 7, {}};
  seen.sensedData[1] = {3.f, 0.2f, 0.f, 8, {}};
  auto command = stamped<mrpt::obs::CObservationRawDAQ>(kStart_s + 1, "command");
  command.AIN_double = {0.5, 0.1};
  command.AIN_channel_count = 2;
  return plainLog(seen, command, gps(kStart_s + 2), pose(kStart_s + 3));
}

/// The seed corpus of tests/data: name -> bytes. Small logs, whole ones and one of each kind of damage we know.
inline std::map<std::string, std::string> seedCorpus(const TemporaryFolder& folder) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  writeLog(folder / "whole", 12);
  const std::string whole = contents(folder / "whole");
  std::string flipped = whole;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x20);
  return {
      {"whole-gzip", whole},
      {"whole-plain", plainLog(odometry(kStart_s, 1, 1), imu(kStart_s + 0.1), gps(kStart_s + 0.2), scan(kStart_s + 0.3),
                               beacons(kStart_s + 0.4, {1, 2, 3}), pose(kStart_s + 0.5))},
      {"frames", frameLog()},
      {"other-classes", otherClasses()},
      {"cut-gzip", whole.substr(0, whole.size() * 2 / 3)},
      {"cut-plain", plainLog(odometry(kStart_s), scan(kStart_s + 1)).substr(0, 250)},
      {"flipped", flipped},
      {"empty", ""},
      {"text", "Dear reader,\nthis is a letter.\n"},
      {"gzip-of-nothing", std::string("\x1f\x8b\x08\0\0\0\0\0\0\x03\x03\0\0\0\0\0\0\0\0\0", 20)},
      {"null-object", "\x87nullptr\x88" + plainLog(odometry(kStart_s))},
      {"not-finite", plainLog(odometry(kStart_s, nan), imu(kStart_s, nan), gps(kStart_s, nan), odometry(kStart_s + 1))},
      {"no-stamps", plainLog(odometry(0), imu(0), odometry(kStart_s))},
      {"no-beams", plainLog(scan(kStart_s, 0), odometry(kStart_s))},
      {"huge-variance", plainLog(pose(kStart_s, 1e308), odometry(kStart_s))},
      {"hostile-length", plainLog(odometry(kStart_s)) + hostileScan()},
  };
}

}  // namespace sidestep::worlds
