// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <memory>
#include <string>
#include <string_view>

namespace sidestep {

/// Writes an observations-only rawlog: gzip level 1, a comment first (program, parameters, seed) and one last with the
/// count, so that a cut log is known as cut. Flushed (zlib full flush), so that what a killed program wrote can be read
/// up to there, by MRPT's tools too.
class LogWriter {
 public:
  /// When what was written is made readable to others: live, each second of log time; offline, where the input is
  /// still there, each 64 KiB, which is a third of the time and half of the size.
  enum class Flush { kEachSecond, kBySize };
  /// @throws DatasetError if the file cannot be created.
  LogWriter(const std::string& file, const std::string& header, Flush flush = Flush::kEachSecond);
  /// Closes without an end marker if `close()` was not called: the log then counts as cut short.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// @throws DatasetError if the disk is full.
  void write(const mrpt::obs::CObservation& observation);
  /// An object of any class, as another log stored it. @throws DatasetError if the disk is full.
  void writeStored(std::string_view bytes);
  /// Writes the end marker and closes. @throws DatasetError if what was written did not reach the disk.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sidestep
