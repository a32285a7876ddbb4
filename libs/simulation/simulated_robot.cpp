// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/simulated_robot.h"

#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <iterator>

#include "simulation/world.h"

namespace sidestep {
namespace {

/// Labels of our own logs are the words of the kinds.
SensorKind kindOf(const std::string& label) {
  const auto& words = kindWords();
  const auto it = std::find(words.begin(), words.end(), label);
  return it == words.end() ? SensorKind::kOther : static_cast<SensorKind>(it - words.begin());
}

}  // namespace

void SimulatedRobot::take(const RobotSensors& sensors) {
  const auto keep = [this](const mrpt::obs::CObservation& o) {
    Reading& r = waiting_.emplace_back();
    r.time_s = mrpt::Clock::toDouble(o.timestamp);
    r.kind = kindOf(o.sensorLabel);
    r.label = o.sensorLabel;
    r.observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(o.duplicateGetSmartPtr());
    last_reading_s_ = std::max(last_reading_s_, r.time_s);
  };
  sensors.tellStep(keep);
  sensors.tellScan(keep);
}

void SimulatedRobot::read(std::vector<Reading>& readings) {
  readings.insert(readings.end(), std::make_move_iterator(waiting_.begin()), std::make_move_iterator(waiting_.end()));
  waiting_.clear();
}

void SimulatedRobot::drive(const mrpt::math::TTwist2D& command) { world_.command(robot_, command); }

void SimulatedRobot::stop() noexcept { world_.command(robot_, {0, 0, 0}); }

RobotHealth SimulatedRobot::health() const {
  RobotHealth out;
  out.last_reading_s = last_reading_s_;
  if (!world_.finished()) return out;
  out.drivable = false;
  out.problem = "the simulated time is over";
  return out;
}

}  // namespace sidestep
