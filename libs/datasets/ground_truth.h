// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace sidestep {

/// A pose with its time.
struct StampedPose {
  double time_s = 0;         ///< Unix time [s]
  mrpt::math::TPose2D pose;  ///< [m, rad]
  bool has_heading = true;
};

/// True poses as a stream: `push` them in time order (or let them be read from a file), ask for times in order.
/// Interpolates linearly (heading along the shorter way) between two that are at most `max_gap_s` apart; a time outside
/// has no truth. Memory does not grow with the length.
class GroundTruth {
 public:
  /// Truth from the log itself: feed with push().
  explicit GroundTruth(double max_gap_s = 1.5);
  /// Truth from a file, streamed: TUM (`t x y z qx qy qz qw`), or MRPT's `t x y yaw` (uwb_ro-localization_demo_GT.txt,
  /// whose first column is a row number: see `isRowIndexed`).
  /// Lines that start with # or % are skipped; commas separate as blanks do. The file is read through once at the door,
  /// so that all its errors are found there. A TUM file cannot say "no heading": if every one of its quaternions is
  /// exactly 0 0 0 1 while y moves by more than 0.1 m, which no robot that looks along x does, its poses have none.
  /// @throws DatasetError missing / corrupt (file:line, what is wrong), also for stamps that go backwards.
  static std::unique_ptr<GroundTruth> fromFile(const std::string& file, double max_gap_s = 1.5);
  ~GroundTruth();

  /// @return false if the pose was left out: not finite, or older than the one before. At most 100000 poses wait to be
  /// asked for; beyond that the oldest go.
  bool push(const StampedPose& pose);
  /// The file's first column counts rows (0, 1, 2 ...) instead of seconds: row k then belongs to the k-th estimate
  /// asked for, see row().
  bool isRowIndexed() const;
  /// Truth at a time; times must not decrease between calls. When poses are pushed, ask for a time once a pose at or
  /// after it has been pushed.
  std::optional<StampedPose> at(double time_s);
  /// Truth of row `index`; indices must not decrease between calls.
  std::optional<StampedPose> row(uint64_t index);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes `t x y z qx qy qz qw` lines: time with 9 decimals, the rest with the fewest digits
/// that read back as the same number.
class TumWriter {
 public:
  /// @throws DatasetError if the file cannot be created.
  explicit TumWriter(const std::string& file);
  ~TumWriter();
  void write(double time_s, const mrpt::math::TPose2D& pose);
  /// @throws DatasetError if what was written did not reach the disk.
  void close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sidestep
