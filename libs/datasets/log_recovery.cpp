// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_recovery.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <filesystem>
#include <optional>

#include "datasets/gzip_salvage.h"
#include "datasets/log_markers.h"
#include "datasets/log_writer.h"
#include "datasets/mapped_file.h"
#include "datasets/object_archive.h"
#include "datasets/object_stream.h"

namespace sidestep {
namespace {

constexpr uint64_t kMostAttempts = 20000;  // each is a process; a file made of false beginnings must not take days

/// Removes a file when done with it.
struct TemporaryFile {
  std::string name;
  ~TemporaryFile() {
    std::error_code ignored;
    if (!name.empty()) std::filesystem::remove(name, ignored);
  }
};

bool isLogClass(const std::string& name) {
  const auto* id = mrpt::rtti::findRegisteredClass(name);
  return id != nullptr &&
         (id->derivedFrom(CLASS_ID(mrpt::obs::CObservation)) || id->derivedFrom(CLASS_ID(mrpt::obs::CSensoryFrame)) ||
          id->derivedFrom(CLASS_ID(mrpt::obs::CActionCollection)));
}

bool looksLikeName(std::string_view name) {
  for (const std::string_view start : {"mrpt::obs::C", "CObservation", "CSensoryFrame", "CActionCollection"})
    if (name.starts_with(start)) return true;
  return false;
}

class Recovery {
 public:
  Recovery(const std::string& out, const DecodeLimits& limits, std::string source)
      : out_name_(out), limits_(limits), source_(std::move(source)) {}

  /// Decodes the ranges of the plain file `name`.
  void run(const std::string& name, const std::vector<IntactRange>& ranges) {
    const MappedFile plain(name);
    for (const IntactRange& range : ranges) {
      if (&range != &ranges.front()) addBreak("gzip data damaged");
      recoverRange(name, plain.bytes().substr(0, range.end), range.begin);
    }
    writer("").close();
  }
  RecoveryReport& report() { return report_; }

 private:
  void recoverRange(const std::string& name, std::string_view bytes, uint64_t at) {
    while (at < bytes.size()) {
      ObjectStream stream(name, limits_, {true, at, bytes.size()});
      while (const auto stored = stream.next()) keep(*stored);
      at += stream.bytes();
      if (stream.failure().empty()) return;
      addBreak(stream.failure());
      size_t next = ++attempts_ < kMostAttempts ? findObject(bytes, at + 1) : std::string_view::npos;
      if (next == std::string_view::npos) next = bytes.size();
      report_.lost_bytes += next - at;
      at = next;
    }
  }

  void keep(const StoredObject& stored) {
    const auto text = stored.object ? commentText(*stored.object) : std::nullopt;
    if (text && (isHeader(*text) || endCount(*text))) {
      if (isHeader(*text)) writer(*text);
      return;
    }
    if (!stored.object) return;  // MRPT's own tools crash on a null object
    writer("").writeStored(stored.bytes);
    ++report_.entries;
    report_.bytes += stored.bytes.size();
  }

  /// The output, begun with the log's own header if that comes first.
  LogWriter& writer(const std::string& header) {
    if (!writer_)
      writer_.emplace(out_name_, header.empty() ? "sidestep: {recovered_from: '" + source_ + "'}\n" : header);
    return *writer_;
  }

  void addBreak(const std::string& reason) {
    ++report_.breaks;
    if (report_.first_damage.empty()) report_.first_damage = reason;
  }

  std::string out_name_;
  DecodeLimits limits_;
  std::string source_;
  std::optional<LogWriter> writer_;
  RecoveryReport report_;
  uint64_t attempts_ = 0;
};

}  // namespace

size_t findObject(std::string_view bytes, size_t from) {
  for (size_t at = from; at < bytes.size(); ++at) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    if ((first & 0x80) == 0) continue;
    const std::string_view name = bytes.substr(at + 1, first & 0x7f);
    if (name.size() == (first & 0x7fu) && looksLikeName(name) && isLogClass(std::string(name))) return at;
  }
  return std::string_view::npos;
}

RecoveryReport recoverLog(const std::string& in, const std::string& out, const DecodeLimits& limits) {
  registerRawlogClasses();
  Recovery recovery(out, limits, std::filesystem::path(in).filename().string());
  if (!isGzip(in)) {
    recovery.run(in, {{0, MappedFile(in).bytes().size()}});
    return recovery.report();
  }
  const TemporaryFile plain{out + ".plain"};
  const SalvagedBytes salvaged = salvageGzip(in, plain.name);
  recovery.run(plain.name, salvaged.ranges);
  recovery.report().skipped_bytes = salvaged.skipped;
  return recovery.report();
}

}  // namespace sidestep
