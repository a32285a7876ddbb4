// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/errors.h"

namespace sidestep {

MappedFile::MappedFile(const std::string& file) {
  const int fd = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat info {};
  if (fd < 0 || fstat(fd, &info) != 0)
    throw DatasetError::missing(file + ": cannot be opened: " + std::strerror(errno));
  size_ = S_ISREG(info.st_mode) ? static_cast<size_t>(info.st_size) : 0;
  void* memory = size_ > 0 ? mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, fd, 0) : nullptr;
  close(fd);
  if (!S_ISREG(info.st_mode)) throw DatasetError::missing(file + ": is not a file");
  if (memory == MAP_FAILED) throw DatasetError::missing(file + ": cannot be read: " + std::strerror(errno));
  data_ = static_cast<char*>(memory);
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(data_, size_);
}

}  // namespace sidestep
