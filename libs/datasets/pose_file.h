// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>

#include "datasets/ground_truth.h"

namespace sidestep {

/// Reads a text file of poses line by line: TUM (8 numbers) or `t x y yaw` (4 numbers); the first line decides.
class PoseFile {
 public:
  /// @throws DatasetError missing.
  explicit PoseFile(const std::string& file);
  /// @throws DatasetError corrupt, `file:line: what is wrong`.
  std::optional<StampedPose> next();
  bool isTum() const { return columns_ == 8; }
  /// Whether the quaternion of the last pose was exactly 0 0 0 1.
  bool lastWasIdentity() const { return identity_; }

 private:
  bool readNumbers(const std::string& line);
  StampedPose toPose();
  double tumYaw();
  [[noreturn]] void fail(const std::string& what) const;

  std::string name_;
  std::ifstream stream_;
  uint64_t line_number_ = 0;
  size_t columns_ = 0;
  std::array<double, 8> numbers_{};
  std::optional<double> last_time_s_;
  bool identity_ = false;
};

}  // namespace sidestep
