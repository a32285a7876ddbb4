// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/gzip_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "core/errors.h"

namespace sidestep {

GzipFile::GzipFile(const std::string& file) : name_(file) {
  fd_ = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const int copy = fd_ < 0 ? -1 : fcntl(fd_, F_DUPFD_CLOEXEC, 0);  // zlib closes its own; this one is for fsync
  if (copy >= 0) gz_ = gzdopen(copy, "wb1");
  if (gz_ != nullptr) {
    gzbuffer(gz_, 1 << 16);
    return;
  }
  const std::string reason = std::strerror(errno);
  if (copy >= 0) ::close(copy);
  if (fd_ >= 0) ::close(fd_);
  throw DatasetError::missing(file + ": cannot be created: " + reason);
}

GzipFile::~GzipFile() {
  if (gz_ != nullptr) gzclose_w(gz_);
  ::close(fd_);
}

void GzipFile::fail(const std::string& reason) {
  throw DatasetError(ExitCode::kInputMissing, name_ + ": cannot be written: " + reason);
}

void GzipFile::write(std::string_view bytes) {
  if (gz_ == nullptr) fail("it is closed");
  while (!bytes.empty()) {
    const auto n = static_cast<unsigned>(std::min<size_t>(bytes.size(), 1 << 30));
    if (gzwrite(gz_, bytes.data(), n) != static_cast<int>(n)) fail(std::strerror(errno));
    bytes.remove_prefix(n);
  }
}

void GzipFile::flush() {
  if (gz_ == nullptr) fail("it is closed");
  if (gzflush(gz_, Z_FULL_FLUSH) != Z_OK) fail(std::strerror(errno));
}

void GzipFile::close() {
  if (gz_ == nullptr) return;
  const int result = gzclose_w(std::exchange(gz_, nullptr));
  if (result != Z_OK) fail(std::strerror(errno));
  if (fsync(fd_) != 0 && errno != EINVAL && errno != EROFS) fail(std::strerror(errno));  // EINVAL: not a disk
}

}  // namespace sidestep
