// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <map>
#include <string>

#include "core/reading.h"

namespace sidestep {

/// A stretch of a log is cut out and the gap closed, as if the robot had been carried in no time from where it was to
/// where it is seen next. What comes later is stamped earlier by the length of the cut, and odometry, of which wheels
/// in the air see nothing, goes on from its last reading: T' = T_last T_first^-1 T, and its ticks likewise.
class LogJump {
 public:
  /// @param from_s, to_s  of the cut, in the log's own time [s]; from_s < to_s
  LogJump(double from_s, double to_s) : from_s_(from_s), to_s_(to_s) {}
  /// To be asked for each entry in order. @param logged_s  its time in the log, before any change
  /// @return false if the entry is cut out; one from after the cut is changed, which copies its observation
  bool apply(double logged_s, Reading& entry);

 private:
  struct Wheels {
    mrpt::math::TPose2D last, moved;  // last reading that was given out; T' = moved T after the cut
    int64_t last_left = 0, last_right = 0, add_left = 0, add_right = 0;
    bool seen = false, anchored = false;
  };
  void carry(Reading& entry, bool after);

  double from_s_, to_s_;
  std::map<std::string, Wheels> wheels_;  // by label
};

}  // namespace sidestep
