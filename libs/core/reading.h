// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/obs/obs_frwds.h>

#include <memory>
#include <string>
#include <vector>

namespace sidestep {

/// What an observation is for, whatever its label says. Labels of our own logs are these words in lower case.
enum class SensorKind { kOdometry, kImu, kGps, kBeacons, kLandmarks, kLaser, kRgbd, kGroundTruth, kEstimate, kOther };

/// All kinds' words, in the order of SensorKind.
const std::vector<std::string>& kindWords();
/// The word of one kind, "odometry" and so on.
std::string word(SensorKind kind);

/// What a sensor said at one instant. A log, the simulator and a device all give these, and nothing else.
struct Reading {
  double time_s = 0;  ///< Unix time of the observation [s], finite, > 0
  SensorKind kind = SensorKind::kOther;
  std::string label;  ///< the sensor label, as in the log, or the kind's word if the log has none
  std::shared_ptr<mrpt::obs::CObservation> observation;  ///< never null; its floats have been screened for its kind
};

}  // namespace sidestep
