// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

namespace sidestep {

/// What decoding may cost before it is taken for damage.
struct DecodeLimits {
  size_t memory_bytes = 1ull << 30;
  double seconds_per_object = 10;  ///< CPU time [s]
};

/// Which bytes of the open file are decoded.
struct DecodeRange {
  bool plain = false;  ///< bytes as they are, from `begin` to `end`; otherwise the whole file, plain or gzip
  uint64_t begin = 0;
  uint64_t end = UINT64_MAX;
};

enum class RecordKind : uint32_t { kObject = 1, kEnd = 2, kFailure = 3 };

/// Before the bytes of each record in the pipe; kFailure's bytes are the reason.
struct RecordHead {
  RecordKind kind = RecordKind::kObject;
  uint32_t pad = 0;
  uint64_t length = 0;    ///< of the bytes that follow
  uint64_t consumed = 0;  ///< bytes of the file consumed
};

/// What parent and child share besides the pipe: whole records that the child has not sent yet. If decoding kills the
/// child, the parent takes them from here, so that nothing that decoded is lost to batching.
struct SharedBatch {
  static constexpr size_t kCapacity = 1 << 16;
  volatile uint64_t used;
  volatile uint32_t sending;  ///< the child died while it sent `data`: part of it is in the pipe
  char data[kCapacity];
};

/// Main function of the decoding child: decodes all objects of `fd`, sends each that decoded, then the end or the
/// reason. Memory and CPU time are bounded; a file that makes MRPT exceed that kills this process only.
[[noreturn]] void runDecoderChild(int fd, int pipe_fd, SharedBatch& batch, const DecodeRange& range,
                                  const DecodeLimits& limits);

}  // namespace sidestep
