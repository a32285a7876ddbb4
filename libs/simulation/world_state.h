// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>
#include <mrpt/math/TTwist2D.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "core/obstacles.h"
#include "core/random.h"
#include "simulation/crowd.h"

namespace sidestep {

/// What a world needs besides its parameters: what was read from files.
struct WorldInputs {
  std::vector<Segment> walls;         ///< of a map, besides those of the parameters
  std::vector<RecordedTrack> tracks;  ///< recorded people, time 0 at the start of the run
};

/// A robot at work.
struct RobotState {
  mrpt::math::TPose2D pose;      ///< true [m, rad]
  mrpt::math::TTwist2D twist;    ///< over the ground, base frame
  mrpt::math::TTwist2D command;  ///< the last one
  mrpt::math::TPose2D goal;      ///< the one it is on its way to
  int goals_reached = 0;
  double radius_m = 0;
  bool arrived = false;  ///< at its last goal
  std::optional<double> arrived_s;
  double path_m = 0;
};

/// The streams of random numbers of a world: each part draws from its own, so that none disturbs another.
enum class WorldStream : uint64_t { kEncoders = 1, kImu, kGps, kLaser, kCrowd, kTracks };
enum class RobotStream : uint64_t { kStart, kWheels, kPerception };

inline Random worldRandom(uint64_t seed, WorldStream what) { return Random(seed, static_cast<uint64_t>(what)); }
inline Random robotRandom(uint64_t seed, size_t robot, RobotStream what) {
  constexpr uint64_t kFirstRobot = 100, kStreamsPerRobot = 3;
  return Random(seed, kFirstRobot + kStreamsPerRobot * robot + static_cast<uint64_t>(what));
}

}  // namespace sidestep
