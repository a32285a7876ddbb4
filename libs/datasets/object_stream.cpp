// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/object_stream.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/errors.h"
#include "core/params.h"
#include "datasets/object_archive.h"

namespace sidestep {
namespace {

/// Closes when it goes out of scope.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() { reset(-1); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  int get() const { return fd_; }
  void reset(int fd) {
    if (fd_ >= 0) close(fd_);
    fd_ = fd;
  }

 private:
  int fd_ = -1;
};

SharedBatch* mapBatch() {
  void* memory = mmap(nullptr, sizeof(SharedBatch), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw Error(ExitCode::kInternalError, "no memory for reading a log");
  return static_cast<SharedBatch*>(memory);
}

std::string deathReason(int status, const DecodeLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGPROF) return "decoding it takes more than " + shortestNumber(limits.seconds_per_object) + " s";
  if (signal == SIGKILL || signal == SIGTERM) return "the decoding process was killed";
  if (status == 0) return "the decoding process ended early";
  return "decoding it needs more than " + std::to_string(limits.memory_bytes >> 20) + " MiB or crashes (" +
         (signal != 0 ? "signal " + std::to_string(signal) : "status " + std::to_string(WEXITSTATUS(status))) + ")";
}

}  // namespace

struct ObjectStream::Impl {
  DecodeLimits limits;
  FileDescriptor file, pipe;
  pid_t child = -1;
  SharedBatch* batch = nullptr;
  std::string buffer;  ///< received, from `parsed` on not yet taken
  size_t parsed = 0;
  bool pipe_closed = false, ended = false;
  std::string failure;
  uint64_t entries = 0, bytes = 0, consumed = 0, size = 0;

  ~Impl() {
    if (child > 0) {
      kill(child, SIGKILL);
      reap();
    }
    if (batch != nullptr) munmap(batch, sizeof(SharedBatch));
  }

  void open(const std::string& name) {
    file.reset(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat info {};
    if (file.get() < 0 || fstat(file.get(), &info) != 0)
      throw DatasetError::missing(name + ": cannot be opened: " + std::strerror(errno));
    if (S_ISDIR(info.st_mode)) throw DatasetError::missing(name + ": is a folder, not a rawlog");
    size = static_cast<uint64_t>(info.st_size);
  }

  void start(const DecodeRange& range) {
    registerRawlogClasses();
    batch = mapBatch();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw Error(ExitCode::kInternalError, "no pipe for reading a log");
    pipe.reset(ends[0]);
    FileDescriptor write_end(ends[1]);
    child = fork();
    if (child == 0) runDecoderChild(file.get(), write_end.get(), *batch, range, limits);
    if (child < 0) throw Error(ExitCode::kInternalError, "no process for reading a log");
  }

  int reap() {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    child = -1;
    return status;
  }

  /// Receives more; at the pipe's end takes what the child could not send any more.
  void receive() {
    buffer.erase(0, parsed);
    parsed = 0;
    char chunk[SharedBatch::kCapacity];
    ssize_t got = 0;
    do {
      got = read(pipe.get(), chunk, sizeof(chunk));
    } while (got < 0 && errno == EINTR);
    if (got > 0) {
      buffer.append(chunk, static_cast<size_t>(got));
      return;
    }
    pipe_closed = true;
    death_ = deathReason(reap(), limits);
    if (batch->sending == 0 && batch->used <= SharedBatch::kCapacity) {
      buffer.append(batch->data, batch->used);
    }
  }

  /// The next whole record's head, or nothing after the last one.
  std::optional<RecordHead> head() {
    for (;;) {
      RecordHead head;
      const size_t there = buffer.size() - parsed;
      if (there >= sizeof(head)) {
        std::memcpy(&head, buffer.data() + parsed, sizeof(head));
        if (head.length > limits.memory_bytes) return {};
        if (there >= sizeof(head) + head.length) return head;
      }
      if (pipe_closed) return {};
      receive();
    }
  }

  std::optional<StoredObject> finish(const std::string& why) {
    ended = true;
    failure = why;
    return {};
  }

  std::optional<StoredObject> object(const RecordHead& record) {
    StoredObject stored{nullptr, buffer.substr(parsed + sizeof(RecordHead), record.length), bytes, record.consumed};
    parsed += sizeof(RecordHead) + record.length;
    consumed = record.consumed;
    try {
      stored.object = objectFromBytes(stored.bytes);
    } catch (const std::exception& error) {
      return finish(reasonOf(error));
    }
    ++entries;
    bytes += record.length;
    return stored;
  }

  std::string death_;
};

ObjectStream::ObjectStream(const std::string& file, const DecodeLimits& limits, const DecodeRange& range)
    : impl_(std::make_unique<Impl>()) {
  impl_->limits = limits;
  impl_->open(file);
  impl_->start(range);
}

ObjectStream::~ObjectStream() = default;

std::optional<StoredObject> ObjectStream::next() {
  if (impl_->ended) return {};
  const auto record = impl_->head();
  if (!record) return impl_->finish(impl_->death_.empty() ? "an entry is too large" : impl_->death_);
  if (record->kind == RecordKind::kObject) return impl_->object(*record);
  if (record->kind == RecordKind::kFailure)
    return impl_->finish(impl_->buffer.substr(impl_->parsed + sizeof(RecordHead), record->length));
  impl_->consumed = impl_->size;
  return impl_->finish("");
}

bool ObjectStream::ended() const { return impl_->ended; }
const std::string& ObjectStream::failure() const { return impl_->failure; }
uint64_t ObjectStream::entries() const { return impl_->entries; }
uint64_t ObjectStream::bytes() const { return impl_->bytes; }
uint64_t ObjectStream::consumed() const { return impl_->consumed; }
uint64_t ObjectStream::fileSize() const { return impl_->size; }

}  // namespace sidestep
