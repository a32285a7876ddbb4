// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_observations.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationRawDAQ.h>

#include <cmath>

namespace sidestep {
namespace {

mrpt::obs::CObservationRawDAQ channels(const char* label, double time_s, const std::vector<double>& values,
                                       size_t a_row) {
  mrpt::obs::CObservationRawDAQ o;
  o.sensorLabel = label;
  o.timestamp = mrpt::Clock::fromDouble(kSimulationStart_s + time_s);
  o.AIN_double.assign(values.begin(), values.end());
  o.AIN_channel_count = static_cast<uint16_t>(a_row);
  return o;
}

}  // namespace

WorldReporter::WorldReporter(const World& world) : world_(world), people_clock_(world.params().people_record_hz) {}

void WorldReporter::tell(const ObservationSink& sink) {
  tellObservations(world_.sensed(), world_.params().encoders, world_.params().gps, sink);
  if (world_.controlled()) {
    // Ordered at the beginning of this step.
    const auto& command = world_.robots()[0].command;
    sink(channels("command", world_.time(), {command.vx, command.omega}, 2));
  }
  if (world_.scan() != nullptr) tellScan(*world_.scan(), sink);
  if (people_clock_.due(world_.time())) tellPeople(sink);
}

void WorldReporter::tellPeople(const ObservationSink& sink) const {
  std::vector<double> values;
  const auto add = [&](size_t id, double x, double y, double vx, double vy, double radius) {
    values.insert(values.end(), {static_cast<double>(id), x, y, vx, vy, radius, 0, 0, 0});
  };
  const auto& people = world_.people();
  for (const Person& p : people)
    if (p.present) add(static_cast<size_t>(p.id), p.position.x, p.position.y, p.velocity.x, p.velocity.y, p.radius_m);
  for (size_t k = 1; k < world_.robots().size(); ++k) {
    const RobotState& r = world_.robots()[k];
    add(people.size() + k, r.pose.x, r.pose.y, r.twist.vx * std::cos(r.pose.phi), r.twist.vx * std::sin(r.pose.phi),
        r.radius_m);
  }
  if (!values.empty()) sink(channels("people", world_.time(), values, 9));
}

void WorldReporter::tellScan(const LaserScanner& scan, const ObservationSink& sink) const {
  const LaserParams& p = scan.params();
  mrpt::obs::CObservation2DRangeScan o;
  o.sensorLabel = "laser";
  o.timestamp = mrpt::Clock::fromDouble(kSimulationStart_s + world_.time());
  o.rightToLeft = true;
  o.aperture = static_cast<float>(p.field);
  o.maxRange = static_cast<float>(p.range_m);
  o.stdError = static_cast<float>(p.range_sd_m);
  o.sensorPose = mrpt::poses::CPose3D(p.x_m, p.y_m, 0, p.yaw, 0, 0);
  const auto& ranges = scan.ranges();
  o.resizeScan(ranges.size());
  for (size_t i = 0; i < ranges.size(); ++i) {
    const bool seen = std::isfinite(ranges[i]);
    o.setScanRange(i, static_cast<float>(seen ? ranges[i] : 0));
    o.setScanRangeValidity(i, seen);
  }
  sink(o);
}

}  // namespace sidestep
