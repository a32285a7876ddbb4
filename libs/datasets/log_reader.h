// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/reading.h"

namespace sidestep {

/// How a log is read.
struct LogReaderOptions {
  /// kind word -> label, from `--label gps=GPS_RTK_REAR`: only that label serves as that kind; a
  /// CObservationRobotPose may be named as gps (victoria_park's gps_xy).
  std::map<std::string, std::string> labels;
  double from_s = 0;                       ///< skip what lies earlier than this after the first stamp [s]
  double to_s = 1e18;                      ///< and what lies later [s]
  double reorder_window_s = 2.0;           ///< observations are sorted by time within this much [s]
  size_t memory_limit_bytes = 1ull << 30;  ///< memory that decoding one log may take [byte]
  double seconds_per_entry = 10;           ///< CPU time that decoding one entry may take [s]
};

/// How a log ended.
struct LogEnd {
  bool damaged = false;  ///< something did not decode, or the file is cut short
  std::string message;   ///< one line: entry, byte and reason; empty when not damaged
  uint64_t entries = 0;  ///< objects read whole
  uint64_t bytes = 0;    ///< uncompressed bytes of these
};

/// A log as a stream of screened observations in time order; memory does not grow with the log's length.
///
/// Reads observation-only logs and action / sensory-frame logs (odometry increments become absolute odometry), plain or
/// gzip. Decoding runs in a child process whose memory and CPU time are bounded, since MRPT allocates whatever a
/// damaged length says; whatever happens there ends this stream with `end().damaged`, never this process. Nothing that
/// is not finite, out of range or without a plausible stamp comes out: it is counted in `refused()`.
class LogReader {
 public:
  /// @throws DatasetError (missing) if the file cannot be opened.
  explicit LogReader(const std::string& file, LogReaderOptions options = {});
  ~LogReader();
  LogReader(const LogReader&) = delete;
  LogReader& operator=(const LogReader&) = delete;

  /// The next observation, or nothing at the end, clean or not (see `end()`).
  std::optional<Reading> next();

  const LogEnd& end() const;
  /// label -> reason -> count of what was screened out; past a thousand labels, the rest together as "(more)".
  const std::map<std::string, std::map<std::string, uint64_t>>& refused() const;
  /// Text of the comment that opens a log of our own (program, parameters, seed), once the first entry was asked for.
  const std::string& header() const;
  /// Whether actions or sensory frames were seen, that is, the log is not observations only.
  bool isFrameLayout() const;
  /// Bytes of the file consumed and its size, for a progress bar.
  uint64_t bytesConsumed() const;
  uint64_t fileSize() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The word of a kind, as labels and options spell it: "odometry", "imu", "gps", "beacons", "landmarks", "laser",

}  // namespace sidestep
