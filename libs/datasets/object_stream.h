// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/serialization/CSerializable.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "datasets/decoder_child.h"

namespace sidestep {

/// One object of a log.
struct StoredObject {
  mrpt::serialization::CSerializable::Ptr object;  ///< null if the log holds a null pointer there
  std::string bytes;                               ///< as stored
  uint64_t offset = 0;                             ///< of its first byte in the uncompressed log
  uint64_t consumed = 0;                           ///< bytes of the file consumed when it was whole
};

/// All objects of a rawlog, one after the other. They are decoded in a child process first and here only if that went
/// well, so whatever a damaged file makes MRPT do (allocate 16 GB, crash, loop) ends the stream and nothing else.
class ObjectStream {
 public:
  /// @throws DatasetError (missing) if the file cannot be opened.
  explicit ObjectStream(const std::string& file, const DecodeLimits& limits = {}, const DecodeRange& range = {});
  ~ObjectStream();
  ObjectStream(const ObjectStream&) = delete;
  ObjectStream& operator=(const ObjectStream&) = delete;

  /// The next object, or nothing at the end, clean or not.
  std::optional<StoredObject> next();

  bool ended() const;
  /// Why the stream ended before the end of the file, in a few words; empty if it did not.
  const std::string& failure() const;
  uint64_t entries() const;   ///< objects read whole
  uint64_t bytes() const;     ///< uncompressed bytes of these
  uint64_t consumed() const;  ///< bytes of the file consumed
  uint64_t fileSize() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sidestep
