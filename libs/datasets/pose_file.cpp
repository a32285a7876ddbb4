// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/pose_file.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/errors.h"

namespace sidestep {
namespace {

constexpr const char* kSeparators = " \t\r,;";

std::string shortest(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// The number that the whole of `token` spells; a leading plus is allowed.
std::optional<double> toNumber(const std::string& token) {
  const char* begin = token.data() + (token[0] == '+' ? 1 : 0);
  const char* end = token.data() + token.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

PoseFile::PoseFile(const std::string& file) : name_(file), stream_(file) {
  if (!stream_) throw DatasetError::missing(file + ": cannot be read: " + std::strerror(errno));
}

void PoseFile::fail(const std::string& what) const {
  throw DatasetError::corrupt(name_ + ":" + std::to_string(line_number_) + ": " + what);
}

std::optional<StampedPose> PoseFile::next() {
  std::string line;
  while (std::getline(stream_, line)) {
    ++line_number_;
    if (!readNumbers(line)) continue;
    const StampedPose pose = toPose();
    if (last_time_s_ && pose.time_s < *last_time_s_)
      fail("time goes backwards, from " + shortest(*last_time_s_) + " to " + shortest(pose.time_s));
    last_time_s_ = pose.time_s;
    return pose;
  }
  return std::nullopt;
}

/// @return false for a comment or an empty line.
bool PoseFile::readNumbers(const std::string& line) {
  size_t count = 0;
  size_t begin = line.find_first_not_of(kSeparators);
  if (begin == std::string::npos || line[begin] == '#' || line[begin] == '%') return false;
  while (begin != std::string::npos) {
    const size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    const std::string token = line.substr(begin, end - begin);
    const auto value = toNumber(token);
    if (!value) fail(std::string("'").append(token, 0, 40).append("' is not a number"));
    if (!std::isfinite(*value)) fail("'" + token + "' is not finite");
    if (count < numbers_.size()) numbers_[count] = *value;
    ++count;
    begin = line.find_first_not_of(kSeparators, end);
  }
  if (columns_ == 0 && count != 8 && count != 4)
    fail(std::to_string(count) + " numbers, expected 8 (t x y z qx qy qz qw) or 4 (t x y yaw)");
  if (columns_ != 0 && count != columns_)
    fail(std::to_string(count) + " numbers, expected " + std::to_string(columns_) + " as in the lines before");
  columns_ = count;
  return true;
}

StampedPose PoseFile::toPose() {
  const double yaw = isTum() ? tumYaw() : numbers_[3];
  return {numbers_[0], {numbers_[1], numbers_[2], yaw}, true};
}

double PoseFile::tumYaw() {
  const double x = numbers_[4], y = numbers_[5], z = numbers_[6], w = numbers_[7];
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(std::abs(length - 1) < 0.1)) fail("quaternion of length " + shortest(length) + ", expected 1");
  identity_ = x == 0 && y == 0 && z == 0 && w == 1;
  return std::atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

}  // namespace sidestep
