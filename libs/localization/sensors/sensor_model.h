// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/reading.h"
#include "localization/measurement.h"

namespace sidestep {

/// What one reading says: motion (wheels, a gyro's rate), measurements, or a refusal by name. Times are the sensor's
/// own, its delay taken off.
struct SensorSays {
  std::shared_ptr<const mrpt::obs::CObservationOdometry> wheels;
  std::optional<double> yaw_rate;         ///< about the base's z axis [rad/s]
  std::vector<Measurement> measurements;  ///< `stream` is left to the localizer
  uint64_t read = 1;                      ///< how many measurements it held, for the counts
  const char* refused = nullptr;          ///< why nothing of it can be used, as metrics.json spells it
};

/// A sensor: given a reading of its kind, says what it means for the pose. It may remember readings before (periods,
/// the local frame of GPS); readings come in the order of time, but for late ones. What is not finite never leaves it.
class SensorModel {
 public:
  virtual ~SensorModel() = default;
  /// `out` is empty; it keeps its memory between calls.
  virtual void interpret(const Reading& reading, SensorSays& out) = 0;
};

}  // namespace sidestep
