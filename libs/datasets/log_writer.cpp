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
  Impl(const std::string& name, Flush when) : file(name), flush(when) {}
  GzipFile file;
  const Flush flush;
  uint64_t count = 0;
  double flushed_s = -1e18;
  size_t unflushed = 0;

  void flushIfDue(double time_s) {
    if (time_s >= flushed_s && time_s < flushed_s + kFlushPeriod_s) return;
    flushed_s = time_s;
    file.flush();
  }
  void write(std::string_view bytes) {
    unflushed += bytes.size();
    if (unflushed > kFlushBytes) {
      file.flush();
      unflushed = 0;
    }
    file.write(bytes);
    ++count;
  }
};

LogWriter::LogWriter(const std::string& file, const std::string& header, Flush flush)
    : impl_(std::make_unique<Impl>(file, flush)) {
  impl_->file.write(bytesFromObject(comment(headerText(header))));
  impl_->file.flush();
}

LogWriter::~LogWriter() = default;

void LogWriter::write(const mrpt::obs::CObservation& observation) {
  if (impl_->flush == Flush::kEachSecond) impl_->flushIfDue(mrpt::Clock::toDouble(observation.timestamp));
  impl_->write(bytesFromObject(observation));
}

void LogWriter::writeStored(std::string_view bytes) { impl_->write(bytes); }

void LogWriter::close() {
  impl_->file.write(bytesFromObject(comment(endText(impl_->count))));
  impl_->file.close();
}

}  // namespace sidestep
