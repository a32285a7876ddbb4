// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/world_observations.h"

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
  world_.sensors().tellStep(sink);
  if (world_.controlled()) {
    // Commanded at the beginning of this step.
    const auto& command = world_.underTest().command;
    sink(channels("command", world_.time(), {command.vx, command.omega}, 2));
  }
  world_.sensors().tellScan(sink);
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
  for (size_t k = 0; k < world_.robots().size(); ++k) {
    if (k == world_.robotUnderTest()) continue;
    const RobotState& r = world_.robots()[k];
    add(people.size() + k, r.pose.x, r.pose.y, r.twist.vx * std::cos(r.pose.phi), r.twist.vx * std::sin(r.pose.phi),
        r.radius_m);
  }
  if (!values.empty()) sink(channels("people", world_.time(), values, 9));
}

}  // namespace sidestep
