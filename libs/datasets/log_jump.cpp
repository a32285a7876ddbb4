// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_jump.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/poses/CPose2D.h>

namespace sidestep {

bool LogJump::apply(double logged_s, Reading& entry) {
  if (logged_s >= from_s_ && logged_s < to_s_) return false;
  const bool after = logged_s >= to_s_;
  if (!after && entry.kind != SensorKind::kOdometry) return true;
  if (after) {
    entry.observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(entry.observation->duplicateGetSmartPtr());
    entry.time_s -= to_s_ - from_s_;
    entry.observation->timestamp = mrpt::Clock::fromDouble(entry.time_s);
  }
  if (entry.kind == SensorKind::kOdometry) carry(entry, after);
  return true;
}

void LogJump::carry(Reading& entry, bool after) {
  auto* o = dynamic_cast<mrpt::obs::CObservationOdometry*>(entry.observation.get());
  if (o == nullptr) return;
  Wheels& w = wheels_[entry.label];
  if (after && w.seen) {
    if (!w.anchored) {
      w.moved = (mrpt::poses::CPose2D(w.last) + (mrpt::poses::CPose2D() - o->odometry)).asTPose();  // last first^-1
      w.add_left = w.last_left - o->encoderLeftTicks;
      w.add_right = w.last_right - o->encoderRightTicks;
      w.anchored = true;
    }
    o->odometry = mrpt::poses::CPose2D(w.moved) + o->odometry;
    o->encoderLeftTicks += static_cast<int32_t>(w.add_left);
    o->encoderRightTicks += static_cast<int32_t>(w.add_right);
  }
  if (after) return;
  w.seen = true;
  w.last = o->odometry.asTPose();
  w.last_left = o->encoderLeftTicks;
  w.last_right = o->encoderRightTicks;
}

}  // namespace sidestep
