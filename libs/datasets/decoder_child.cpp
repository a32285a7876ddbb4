// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/decoder_child.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "core/process_limits.h"
#include "datasets/object_archive.h"

namespace sidestep {
namespace {

constexpr int kPipe = 3;
constexpr int kFile = 4;

/// The child dies of a broken pipe if the parent does, and of its CPU limit if it loops. It needs no parent-death
/// signal, which would also fire when only the thread that opened the log ends. Ctrl-C is the parent's to handle.
void resetSignals() {
  for (const int signal : {SIGPIPE, SIGPROF, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGCHLD})
    std::signal(signal, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Leaves open nothing but the pipe and the file: an inherited pipe of another reader would hide its child's end.
void arrangeFiles(int fd, int pipe_fd) {
  const int pipe_copy = fcntl(pipe_fd, F_DUPFD, 10), file_copy = fcntl(fd, F_DUPFD, 10);
  dup2(pipe_copy, kPipe);
  dup2(file_copy, kFile);
  const int null = open("/dev/null", O_RDWR);
  for (int std_fd : {0, 1, 2}) dup2(null, std_fd);
  close_range(5, ~0u, 0);
}

class RecordSink {
 public:
  explicit RecordSink(SharedBatch& batch) : batch_(batch) {}

  void put(RecordKind kind, uint64_t consumed, const char* bytes, size_t length) {
    const RecordHead head{kind, 0, length, consumed};
    const size_t total = sizeof(head) + length;
    if (batch_.used + total > SharedBatch::kCapacity) flush();
    if (total > SharedBatch::kCapacity) {
      send(&head, sizeof(head));
      send(bytes, length);
      return;
    }
    char* at = batch_.data + batch_.used;
    std::memcpy(at, &head, sizeof(head));
    std::memcpy(at + sizeof(head), bytes, length);
    std::atomic_signal_fence(std::memory_order_release);
    batch_.used = batch_.used + total;
  }

  void flush() {
    batch_.sending = 1;
    send(batch_.data, batch_.used);
    batch_.used = 0;
    batch_.sending = 0;
  }

 private:
  static void send(const void* from, size_t n) {
    const char* at = static_cast<const char*>(from);
    while (n > 0) {
      const ssize_t done = write(kPipe, at, n);
      if (done < 0 && errno == EINTR) continue;
      if (done < 0) _exit(0);  // the reader has closed the pipe
      at += done;
      n -= static_cast<size_t>(done);
    }
  }
  SharedBatch& batch_;
};

std::unique_ptr<ByteSource> openSource(const DecodeRange& range) {
  if (range.plain) return std::make_unique<SliceSource>(kFile, range.begin, range.end);
  return std::make_unique<GzipSource>(kFile);
}

/// Decodes until the end of the source. @throws what MRPT throws on damage
void decodeObjects(ByteSource& source, RecordingArchive& archive, RecordSink& sink, double seconds) {
  for (;;) {
    limitCpuTime(seconds);
    if (!archive.startObject()) return;
    archive.ReadObject();
    limitCpuTime(0);  // waiting for the reader does not count
    sink.put(RecordKind::kObject, source.consumed(), archive.bytes().data(), archive.bytes().size());
  }
}

std::string decodeAndExplain(ByteSource& source, RecordSink& sink, const DecodeLimits& limits) {
  RecordingArchive archive(source);
  try {
    decodeObjects(source, archive, sink, limits.seconds_per_object);
    return "";
  } catch (const std::bad_alloc&) {
    return "decoding it needs more than " + std::to_string(limits.memory_bytes >> 20) + " MiB";
  } catch (const std::exception& error) {
    return archive.failure().empty() ? reasonOf(error) : archive.failure();
  }
}

}  // namespace

void runDecoderChild(int fd, int pipe_fd, SharedBatch& batch, const DecodeRange& range, const DecodeLimits& limits) {
  try {
    resetSignals();
    arrangeFiles(fd, pipe_fd);
    limitMemory(limits.memory_bytes);
    const auto source = openSource(range);
    RecordSink sink(batch);
    const std::string reason = decodeAndExplain(*source, sink, limits);
    limitCpuTime(0);
    const RecordKind kind = reason.empty() ? RecordKind::kEnd : RecordKind::kFailure;
    sink.put(kind, source->consumed(), reason.data(), reason.size());
    sink.flush();
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

}  // namespace sidestep
