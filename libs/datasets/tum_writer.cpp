// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "core/errors.h"
#include "datasets/ground_truth.h"

namespace sidestep {
namespace {

void appendShortest(std::string& line, double value) {
  std::array<char, 32> text;
  line += ' ';
  line.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value + 0.0).ptr);
}

}  // namespace

struct TumWriter::Impl {
  std::string name;
  std::FILE* file = nullptr;
  bool failed = false;

  ~Impl() {
    if (file) std::fclose(file);
  }
};

TumWriter::TumWriter(const std::string& file) : impl_(std::make_unique<Impl>()) {
  impl_->name = file;
  impl_->file = std::fopen(file.c_str(), "w");
  if (!impl_->file) throw DatasetError::missing(file + ": cannot be written: " + std::strerror(errno));
}

TumWriter::~TumWriter() = default;

void TumWriter::write(double time_s, const mrpt::math::TPose2D& pose) {
  std::array<char, 400> time;  // the largest double has 309 digits before the point
  const auto end = std::to_chars(time.data(), time.data() + time.size(), time_s, std::chars_format::fixed, 9).ptr;
  std::string line(time.data(), end);
  for (const double value : {pose.x, pose.y}) appendShortest(line, value);
  line += " 0 0 0";
  for (const double value : {std::sin(pose.phi / 2), std::cos(pose.phi / 2)}) appendShortest(line, value);
  line += '\n';
  if (std::fwrite(line.data(), 1, line.size(), impl_->file) != line.size()) impl_->failed = true;
}

void TumWriter::close() {
  if (!impl_->file) return;
  const int status = std::fclose(impl_->file);
  impl_->file = nullptr;
  if (status != 0 || impl_->failed)
    throw DatasetError::missing(impl_->name + ": could not be written to its end: " + std::strerror(errno));
}

}  // namespace sidestep
