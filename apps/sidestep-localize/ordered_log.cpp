// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-localize/ordered_log.h"

#include <mrpt/obs/CObservation.h>

#include <limits>

#include "datasets/object_archive.h"

namespace sidestep {
namespace {
constexpr size_t kHeldBytes = 64 << 20;
}

OrderedLog::OrderedLog(const std::string& file, const std::string& header)
    : log_(file, header, LogWriter::Flush::kBySize) {}

void OrderedLog::input(double time_s, const mrpt::obs::CObservation& observation) {
  held_.push_back({time_s, bytesFromObject(observation)});
  held_bytes_ += held_.back().bytes.size();
  if (held_bytes_ > kHeldBytes) releaseUntil(std::numeric_limits<double>::infinity());
}

void OrderedLog::estimate(double time_s, const mrpt::obs::CObservation& observation) {
  releaseUntil(time_s);
  log_.write(observation);
}

void OrderedLog::releaseUntil(double time_s) {
  while (!held_.empty() && held_.front().time_s <= time_s) {
    log_.writeStored(held_.front().bytes);
    held_bytes_ -= held_.front().bytes.size();
    held_.pop_front();
  }
}

void OrderedLog::close() {
  releaseUntil(std::numeric_limits<double>::infinity());
  log_.close();
}

}  // namespace sidestep
