// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/gzip_salvage.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>

#include "core/errors.h"
#include "datasets/mapped_file.h"

namespace sidestep {
namespace {

constexpr int kGzipMember = 15 + 16;  // zlib's windowBits: with header and checksum
constexpr int kRawDeflate = -15;      // bare
constexpr size_t kTrailer = 8;        // checksum and length after a member

/// Where inflating can start anew.
struct Restart {
  size_t at;
  int window_bits;
};

class Salvage {
 public:
  Salvage(std::string_view in, const std::string& out_name)
      : in_(in), out_(out_name, std::ios::binary), name_(out_name) {}

  SalvagedBytes run() {
    Restart next{0, kGzipMember};
    while (next.at < in_.size()) {
      const uint64_t begin = written_;
      const size_t end = inflateFrom(next);
      addRange(begin, next.at);
      next = restartAfter(end);
    }
    out_.close();
    if (!out_) throw DatasetError::missing(name_ + ": cannot be written");
    return std::move(result_);
  }

 private:
  /// Writes what inflates from there on; gives the place of the first byte not used.
  size_t inflateFrom(const Restart& start) {
    z_stream z{};
    if (inflateInit2(&z, start.window_bits) != Z_OK) throw Error(ExitCode::kInternalError, "no memory for zlib");
    std::vector<Bytef> chunk(1 << 17);
    size_t at = start.at;
    int status = Z_OK;
    while (status == Z_OK && at < in_.size()) {
      const auto n = static_cast<uInt>(std::min<size_t>(in_.size() - at, chunk.size()));
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in_.data() + at));
      z.avail_in = n;
      do {
        z.next_out = chunk.data();
        z.avail_out = static_cast<uInt>(chunk.size());
        status = inflate(&z, Z_NO_FLUSH);
        emit(chunk.data(), chunk.size() - z.avail_out);
      } while (status == Z_OK && z.avail_out == 0);
      at += n - z.avail_in;
      if (status == Z_BUF_ERROR) status = Z_OK;  // only wants more input
    }
    inflateEnd(&z);
    whole_ = status == Z_STREAM_END;
    if (whole_ && start.window_bits == kRawDeflate) at = std::min(in_.size(), at + kTrailer);
    return std::max(at, start.at + 1);
  }

  void emit(const Bytef* bytes, size_t n) {
    out_.write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(n));
    if (!out_) throw DatasetError::missing(name_ + ": cannot be written");
    written_ += n;
  }

  /// Adjacent members belong together; after a break begins a new range.
  void addRange(uint64_t begin, size_t restarted_at) {
    const bool adjacent = previous_whole_ && restarted_at == previous_end_;
    if (adjacent && !result_.ranges.empty()) {
      result_.ranges.back().end = written_;
    } else if (written_ > begin) {
      result_.ranges.push_back({begin, written_});
    }
    previous_whole_ = whole_;
  }

  Restart restartAfter(size_t at) {
    previous_end_ = at;
    const std::string_view mark("\0\0\xff\xff", 4), magic("\x1f\x8b\x08", 3);
    if (in_.substr(at, magic.size()) == magic) return {at, kGzipMember};
    const size_t from = whole_ ? at : at - std::min<size_t>(at, mark.size() - 1);
    const size_t flush = std::min(in_.find(mark, from), in_.size() - mark.size());
    const size_t member = std::min(in_.find(magic, at), in_.size());
    Restart next{std::max(at, flush + mark.size()), kRawDeflate};
    if (member < next.at) next = {member, kGzipMember};
    result_.skipped += next.at - at;
    return next;
  }

  std::string_view in_;
  std::ofstream out_;
  std::string name_;
  SalvagedBytes result_;
  uint64_t written_ = 0;
  bool whole_ = false, previous_whole_ = false;
  size_t previous_end_ = 0;
};

}  // namespace

SalvagedBytes salvageGzip(const std::string& in, const std::string& out) {
  const MappedFile file(in);
  return Salvage(file.bytes(), out).run();
}

bool isGzip(const std::string& file) { return MappedFile(file).bytes().substr(0, 2) == "\x1f\x8b"; }

}  // namespace sidestep
