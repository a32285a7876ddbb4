// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/frame_unpacker.h"

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <optional>

namespace sidestep {
namespace {

double seconds(mrpt::Clock::time_point stamp) {
  return stamp == INVALID_TIMESTAMP ? 0.0 : mrpt::Clock::toDouble(stamp);
}

/// The odometer's own increment where there is one, else the mean of what scan matching found.
std::optional<mrpt::poses::CPose2D> increment(const mrpt::obs::CActionRobotMovement2D& move) {
  if (move.estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry) return move.rawOdometryIncrementReading;
  if (!move.poseChange) return {};
  return move.poseChange->getMeanVal();
}

/// One movement of the collection, the odometer's rather than another.
const mrpt::obs::CActionRobotMovement2D* movement(const mrpt::obs::CActionCollection& actions) {
  const mrpt::obs::CActionRobotMovement2D* best = nullptr;
  for (size_t i = 0; i < actions.size(); ++i) {
    const auto* move = dynamic_cast<const mrpt::obs::CActionRobotMovement2D*>(&actions.get(i));
    if (move == nullptr) continue;
    if (move->estimationMethod == mrpt::obs::CActionRobotMovement2D::emOdometry) return move;
    if (best == nullptr) best = move;
  }
  return best;
}

/// The first valid stamp; 0 if there is none.
double stampOf(const mrpt::obs::CSensoryFrame& frame) {
  for (const auto& observation : frame)
    if (observation && stampSeconds(*observation) > 0) return stampSeconds(*observation);
  return 0;
}

}  // namespace

double stampSeconds(const mrpt::obs::CObservation& observation) { return seconds(observation.timestamp); }

FrameUnpacker::Observations FrameUnpacker::push(const mrpt::serialization::CSerializable::Ptr& object) {
  Observations out;
  if (auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object)) {
    out.push_back(std::move(observation));
  } else if (const auto actions = std::dynamic_pointer_cast<mrpt::obs::CActionCollection>(object)) {
    frames_ = true;
    takeAction(*actions, out);
  } else if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object)) {
    frames_ = true;
    takeFrame(*frame, out);
  }
  return out;
}

FrameUnpacker::Observations FrameUnpacker::flush() {
  Observations out;
  releaseOdometry(0, out);
  return out;
}

void FrameUnpacker::takeAction(const mrpt::obs::CActionCollection& actions, Observations& out) {
  releaseOdometry(0, out);
  const auto* move = movement(actions);
  const auto step = move ? increment(*move) : std::nullopt;
  if (!step) return;
  const bool finite = std::isfinite(step->x()) && std::isfinite(step->y()) && std::isfinite(step->phi());
  if (finite) odometry_ = odometry_ + *step;  // one damaged increment must not spoil all that follow
  odometry_waits_ = finite;
  action_s_ = seconds(move->timestamp);
}

void FrameUnpacker::takeFrame(mrpt::obs::CSensoryFrame& frame, Observations& out) {
  const double frame_s = stampOf(frame);
  releaseOdometry(frame_s, out);
  const double stamp_s = frame_s > 0 ? frame_s : action_s_;
  for (const auto& observation : frame) {
    if (!observation) continue;
    if (stampSeconds(*observation) <= 0 && stamp_s > 0) observation->timestamp = mrpt::Clock::fromDouble(stamp_s);
    out.push_back(observation);
  }
  action_s_ = 0;
}

void FrameUnpacker::releaseOdometry(double frame_s, Observations& out) {
  if (!odometry_waits_) return;
  odometry_waits_ = false;
  const double t = frame_s > 0 ? frame_s : action_s_;
  auto odometry = mrpt::obs::CObservationOdometry::Create();
  odometry->odometry = odometry_;
  odometry->sensorLabel = "odometry";
  odometry->timestamp = t > 0 ? mrpt::Clock::fromDouble(t) : INVALID_TIMESTAMP;
  out.push_back(odometry);
}

}  // namespace sidestep
