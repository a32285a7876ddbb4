// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "datasets/log_reader.h"

namespace sidestep {

/// One label's observations, those that passed the screening.
struct LabelHealth {
  std::string class_name;  ///< without the namespace
  SensorKind kind = SensorKind::kOther;
  uint64_t count = 0;
  double first_s = 0, last_s = 0;  ///< Unix time [s]
  double rate_hz = 0;              ///< mean over first to last
  double period_s = 0;             ///< median, to about 5 %
  double jitter_s = 0;             ///< half of what lies between the 5 % and the 95 % quantile of the periods
  double largest_gap_s = 0;
  double largest_gap_at_s = 0;  ///< Unix time of its beginning [s]
  uint64_t gaps = 0;            ///< periods over five times the median
  uint64_t repeated_stamps = 0;
};

enum class Verdict { kHealthy, kUsableWithCare, kDamaged };

/// What a log holds and what is wrong with it.
struct LogHealth {
  std::string file;
  std::string format;  ///< "gzip, observations" and so on
  uint64_t file_bytes = 0;
  double first_s = 0, last_s = 0;  ///< Unix time [s]; both 0 if nothing passed
  LogEnd end;
  std::map<std::string, LabelHealth> labels;
  std::map<std::string, std::map<std::string, uint64_t>> refused;  ///< see LogReader::refused
  Verdict verdict = Verdict::kHealthy;
  std::vector<std::string> reasons;  ///< why the verdict is not "healthy"
};

/// "healthy", "usable with care", "damaged".
std::string word(Verdict verdict);

/// Reads the log once; memory does not grow with its length.
/// @param progress told of bytes consumed now and then, for a progress bar; may be empty.
/// @throws DatasetError (missing), ConfigError as LogReader.
LogHealth examineLog(const std::string& file, const LogReaderOptions& options,
                     const std::function<void(uint64_t done, uint64_t size)>& progress = {});

}  // namespace sidestep
