// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulation/observations.h"
#include "simulation/world.h"

namespace sidestep {

/// Writes a world as it goes on: `odometry`, `imu`, `gps`, `ground_truth`, `laser` of the robot under test;
/// `command` whenever it is commanded; `people`: all who are there, and the other robots with ids after theirs, as they
/// truly are.
class WorldReporter {
 public:
  explicit WorldReporter(const World& world);
  /// To be told after each step, and once before the first.
  void tell(const ObservationSink& sink);

 private:
  void tellPeople(const ObservationSink& sink) const;

  const World& world_;
  SampleClock people_clock_;
};

}  // namespace sidestep
