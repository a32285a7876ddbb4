// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sidestep {

/// Where the bytes of stored objects come from.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Reads up to `n` bytes, fewer only at the end.
  /// @throws std::runtime_error in a few words, if the compression is damaged or cut short.
  virtual size_t read(void* to, size_t n) = 0;
  /// Bytes of the file consumed so far.
  virtual uint64_t consumed() const = 0;
};

/// A plain or gzip file. Unlike MRPT's stream it tells a damaged or cut member from the end.
class GzipSource : public ByteSource {
 public:
  /// Takes over `fd`.
  explicit GzipSource(int fd);
  ~GzipSource() override;
  size_t read(void* to, size_t n) override;
  uint64_t consumed() const override;

 private:
  gzFile file_;
};

/// Bytes [begin, end) of a plain file.
class SliceSource : public ByteSource {
 public:
  SliceSource(int fd, uint64_t begin, uint64_t end) : fd_(fd), at_(begin), end_(end) {}
  size_t read(void* to, size_t n) override;
  uint64_t consumed() const override { return at_; }

 private:
  int fd_;
  uint64_t at_;
  uint64_t end_;
};

/// Reads objects from a source and remembers the bytes of the present one. Where MRPT's archives give fewer bytes than
/// asked for and leave the rest of a field unset, this one throws.
class RecordingArchive : public mrpt::serialization::CArchive {
 public:
  explicit RecordingArchive(ByteSource& source) : source_(source) {}
  /// Forgets the last object's bytes and looks for another one's first byte; false at the end.
  bool startObject();
  const std::vector<char>& bytes() const { return bytes_; }
  /// What the source said when it failed, since MRPT may replace an exception's text by its own.
  const std::string& failure() const { return failure_; }

 protected:
  size_t read(void* to, size_t n) override;
  size_t write(const void*, size_t) override { return 0; }

 private:
  size_t readSource(char* to, size_t n);
  ByteSource& source_;
  std::vector<char> bytes_;
  bool first_byte_waits_ = false;
  std::string failure_;
};

/// One object from bytes that hold it whole.
mrpt::serialization::CSerializable::Ptr objectFromBytes(std::string_view bytes);
/// The bytes of one object.
std::string bytesFromObject(const mrpt::serialization::CSerializable& object);

/// The line of an MRPT exception that says what happened; its text also holds a call stack.
std::string reasonOf(const std::exception& error);

/// Makes all classes that a rawlog may hold known to MRPT; a program linked with --as-needed knows none.
void registerRawlogClasses();

}  // namespace sidestep
