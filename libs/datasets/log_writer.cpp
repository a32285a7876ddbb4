// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_writer.h"

#include <mrpt/obs/CObservationComment.h>

#include "datasets/gzip_file.h"
#include "datasets/log_markers.h"
#include "datasets/object_archive.h"

namespace sidestep {
namespace {

constexpr double kFlushPeriod_s = 1.0;
constexpr size_t kFlushBytes = 64 << 10;  // where the stamps are not looked at

mrpt::obs::CObservationComment comment(const std::string& text) {
  mrpt::obs::CObservationComment out;
  out.text = text;
  out.timestamp = INVALID_TIMESTAMP;  // not the present: the same run must give the same bytes
  return out;
}

}  // namespace

struct LogWriter::Impl {
  explicit Impl(const std::string& name) : file(name) {}
  GzipFile file;
  uint64_t count = 0;
  double flushed_s = -1e18;
  size_t unflushed = 0;

  void flushIfDue(double time_s) {
    if (time_s >= flushed_s && time_s < flushed_s + kFlushPeriod_s) return;
    flushed_s = time_s;
    file.flush();
  }
};

LogWriter::LogWriter(const std::string& file, const std::string& header) : impl_(std::make_unique<Impl>(file)) {
  impl_->file.write(bytesFromObject(comment(headerText(header))));
  impl_->file.flush();
}

LogWriter::~LogWriter() = default;

void LogWriter::write(const mrpt::obs::CObservation& observation) {
  impl_->flushIfDue(mrpt::Clock::toDouble(observation.timestamp));
  impl_->file.write(bytesFromObject(observation));
  ++impl_->count;
}

void LogWriter::writeStored(std::string_view bytes) {
  impl_->unflushed += bytes.size();
  if (impl_->unflushed > kFlushBytes) {
    impl_->file.flush();
    impl_->unflushed = 0;
  }
  impl_->file.write(bytes);
  ++impl_->count;
}

void LogWriter::close() {
  impl_->file.write(bytesFromObject(comment(endText(impl_->count))));
  impl_->file.close();
}

}  // namespace sidestep
