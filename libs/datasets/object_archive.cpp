// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/object_archive.h"

#include <mrpt/maps/registerAllClasses.h>
#include <mrpt/obs/registerAllClasses.h>
#include <mrpt/poses/registerAllClasses.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace sidestep {
namespace {

constexpr size_t kChunk = 1 << 20;

class SpanArchive : public mrpt::serialization::CArchive {
 public:
  explicit SpanArchive(std::string_view bytes) : rest_(bytes) {}

 protected:
  size_t read(void* to, size_t n) override {
    if (n > rest_.size()) throw std::runtime_error("the object is cut short");
    std::memcpy(to, rest_.data(), n);
    rest_.remove_prefix(n);
    return n;
  }
  size_t write(const void*, size_t) override { return 0; }

 private:
  std::string_view rest_;
};

class StringArchive : public mrpt::serialization::CArchive {
 public:
  std::string bytes;

 protected:
  size_t read(void*, size_t) override { return 0; }
  size_t write(const void* from, size_t n) override {
    bytes.append(static_cast<const char*>(from), n);
    return n;
  }
};

std::string gzipReason(gzFile file) {
  int code = Z_OK;
  std::string text = gzerror(file, &code);
  if (const size_t colon = text.find(": "); colon != std::string::npos) text.erase(0, colon + 2);  // "<fd:4>: "
  if (code == Z_BUF_ERROR) return "gzip data cut short";
  if (code == Z_ERRNO) return std::string("cannot be read: ") + std::strerror(errno);
  return "gzip data damaged" + (text.empty() ? "" : " (" + text + ")");
}

}  // namespace

GzipSource::GzipSource(int fd) : file_(gzdopen(fd, "rb")) {
  if (file_ == nullptr) throw std::runtime_error("zlib cannot open it");
  gzbuffer(file_, 1 << 17);
}

GzipSource::~GzipSource() { gzclose_r(file_); }

size_t GzipSource::read(void* to, size_t n) {
  const int got = gzread(file_, to, static_cast<unsigned>(std::min(n, kChunk)));
  if (got < 0) throw std::runtime_error(gzipReason(file_));
  if (got > 0 || n == 0) return static_cast<size_t>(got);
  int code = Z_OK;
  gzerror(file_, &code);
  if (code != Z_OK && code != Z_STREAM_END) throw std::runtime_error(gzipReason(file_));
  return 0;
}

uint64_t GzipSource::consumed() const {
  const z_off_t at = gzoffset(file_);
  return at < 0 ? 0 : static_cast<uint64_t>(at);
}

size_t SliceSource::read(void* to, size_t n) {
  n = std::min<size_t>({n, kChunk, end_ - at_});
  ssize_t got = 0;
  do {
    got = pread(fd_, to, n, static_cast<off_t>(at_));
  } while (got < 0 && errno == EINTR);
  if (got < 0) throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  at_ += static_cast<uint64_t>(got);
  return static_cast<size_t>(got);
}

bool RecordingArchive::startObject() {
  bytes_.clear();
  char first = 0;
  first_byte_waits_ = readSource(&first, 1) == 1;
  return first_byte_waits_;
}

size_t RecordingArchive::readSource(char* to, size_t n) {
  size_t done = 0;
  try {
    while (done < n) {
      const size_t got = source_.read(to + done, n - done);
      if (got == 0) break;
      bytes_.insert(bytes_.end(), to + done, to + done + got);
      done += got;
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    failure_ = error.what();
    throw;
  }
  return done;
}

size_t RecordingArchive::read(void* to, size_t n) {
  char* out = static_cast<char*>(to);
  size_t done = 0;
  if (first_byte_waits_ && n > 0) {
    *out = bytes_.front();
    first_byte_waits_ = false;
    done = 1;
  }
  done += readSource(out + done, n - done);
  if (done < n) {
    failure_ = "the last entry is cut short";
    throw std::runtime_error(failure_);
  }
  return n;
}

mrpt::serialization::CSerializable::Ptr objectFromBytes(std::string_view bytes) {
  SpanArchive archive(bytes);
  return archive.ReadObject();
}

std::string bytesFromObject(const mrpt::serialization::CSerializable& object) {
  StringArchive archive;
  archive << object;
  return std::move(archive.bytes);
}

std::string reasonOf(const std::exception& error) {
  std::string text = error.what();
  const std::string key = "Message:";
  if (const size_t at = text.rfind(key); at != std::string::npos) text.erase(0, at + key.size());  // the original one
  if (text.starts_with("  Expecting 0x00")) return "no entry begins there";
  const size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "unknown error";
  text = text.substr(begin, text.find_first_of("\r\n", begin) - begin);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';  // names of damaged classes
  return text.substr(0, 200);
}

void registerRawlogClasses() {
  mrpt::poses::registerAllClasses_mrpt_poses();
  mrpt::obs::registerAllClasses_mrpt_obs();
  mrpt::maps::registerAllClasses_mrpt_maps();
}

}  // namespace sidestep
