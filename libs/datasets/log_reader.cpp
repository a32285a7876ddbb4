// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_reader.h"

#include <mrpt/obs/CObservation.h>

#include <cmath>
#include <ctime>
#include <limits>

#include "datasets/frame_unpacker.h"
#include "datasets/kind_rules.h"
#include "datasets/log_markers.h"
#include "datasets/object_stream.h"
#include "datasets/reorder_buffer.h"
#include "datasets/screening.h"

namespace sidestep {
namespace {
constexpr size_t kMostLabels = 1000;
}  // namespace

struct LogReader::Impl {
  Impl(const std::string& name, LogReaderOptions given)
      : file(name),
        options(std::move(given)),
        rules(options.labels),
        stream(name, {options.memory_limit_bytes, options.seconds_per_entry}),
        sorted(options.reorder_window_s,
               [this](const Reading& entry, const char* reason) { count(entry.label, reason); }) {}

  std::string file;
  LogReaderOptions options;
  KindRules rules;
  ObjectStream stream;
  ReorderBuffer sorted;
  FrameUnpacker unpacker;
  MarkerCheck markers;
  LogEnd end;
  bool finished = false;
  double now_s = static_cast<double>(std::time(nullptr));
  double first_s = std::numeric_limits<double>::quiet_NaN();
  std::map<std::string, std::map<std::string, uint64_t>> refused;

  void readObject() {
    const auto stored = stream.next();
    if (!stored) return finish();
    end.entries = stream.entries();
    end.bytes = stream.bytes();
    if (markers.see(stored->object.get())) return;
    if (!stored->object) return count("null", "null object");
    if (commentText(*stored->object)) return;  // a comment has no stamp of its own
    const auto observations = unpacker.push(stored->object);
    if (observations.empty() && !unpacker.isFrameLayout())
      return count(stored->object->GetRuntimeClass()->className, "not an observation");
    for (const auto& observation : observations) take(observation, stored->bytes.size() / observations.size());
  }

  void take(const std::shared_ptr<mrpt::obs::CObservation>& observation, size_t bytes) {
    Reading entry{stampSeconds(*observation), SensorKind::kOther, "", observation};
    entry.kind = rules.classify(*observation, entry.label);
    std::string reason = screenStamp(entry.time_s, now_s);
    if (reason.empty()) reason = screen(*observation, [&](const std::string& why) { count(entry.label, why); });
    if (!reason.empty()) return count(entry.label, reason);
    sorted.push(std::move(entry), bytes);
  }

  void count(const std::string& label, const std::string& reason) {
    const bool room = refused.size() < kMostLabels || refused.contains(label);
    ++refused[room ? label : "(more)"][reason];
  }

  void finish() {
    for (const auto& observation : unpacker.flush()) take(observation, 0);
    sorted.finish();
    finished = true;
    end.damaged = true;
    if (!stream.failure().empty()) {
      end.message = damage();
    } else if (end.entries == 0) {
      end.message = file + ": holds no entries, so it is not a rawlog";
    } else if (const std::string verdict = markers.verdict(); !verdict.empty()) {
      end.message = file + ": " + verdict + "; what came before is kept";
    } else {
      end.damaged = false;
    }
  }

  std::string damage() const {
    if (end.entries == 0) return file + ": not a rawlog, or damaged from the start: " + stream.failure();
    return file + ": damaged at entry " + std::to_string(end.entries) + ", byte " + std::to_string(end.bytes) + ": " +
           stream.failure() + "; what came before is kept";
  }

  bool inWindow(const Reading& entry) {
    if (std::isnan(first_s)) first_s = entry.time_s;
    const double t = entry.time_s - first_s;
    return t >= options.from_s && t <= options.to_s;
  }
};

LogReader::LogReader(const std::string& file, LogReaderOptions options)
    : impl_(std::make_unique<Impl>(file, std::move(options))) {}

LogReader::~LogReader() = default;

std::optional<Reading> LogReader::next() {
  for (;;) {
    if (auto entry = impl_->sorted.pop()) {
      if (impl_->inWindow(*entry)) return entry;
    } else if (impl_->finished) {
      return {};
    } else {
      impl_->readObject();
    }
  }
}

const LogEnd& LogReader::end() const { return impl_->end; }
const std::map<std::string, std::map<std::string, uint64_t>>& LogReader::refused() const { return impl_->refused; }
const std::string& LogReader::header() const { return impl_->markers.header(); }
bool LogReader::isFrameLayout() const { return impl_->unpacker.isFrameLayout(); }
uint64_t LogReader::bytesConsumed() const { return impl_->stream.consumed(); }
uint64_t LogReader::fileSize() const { return impl_->stream.fileSize(); }

}  // namespace sidestep
