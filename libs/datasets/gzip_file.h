// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <zlib.h>

#include <string>
#include <string_view>

namespace sidestep {

/// A gzip file whose every write is checked.
class GzipFile {
 public:
  /// @throws DatasetError if it cannot be created.
  explicit GzipFile(const std::string& file);
  /// Closes; errors are lost.
  ~GzipFile();
  GzipFile(const GzipFile&) = delete;
  GzipFile& operator=(const GzipFile&) = delete;

  /// @throws DatasetError if the disk is full.
  void write(std::string_view bytes);
  /// Brings all so far into the file, so that reading can also start here. @throws DatasetError as `write`.
  void flush();
  /// @throws DatasetError if something did not reach the disk.
  void close();

 private:
  [[noreturn]] void fail(const std::string& reason);
  std::string name_;
  int fd_ = -1;
  gzFile gz_ = nullptr;
};

}  // namespace sidestep
