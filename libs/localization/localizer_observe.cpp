// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The door for sensors: readings of one instant become motion and measurements; localizer.cpp puts them in their
// places.
#include <mrpt/obs/CObservationOdometry.h>

#include <algorithm>
#include <cmath>

#include "localization/localizer.h"
#include "localization/sensors/imu.h"
#include "localization/sensors/odometry.h"

namespace sidestep {

int Localizer::streamOf(const Reading& reading) {
  const auto [it, is_new] = streams_.try_emplace({reading.kind, reading.label}, static_cast<int>(sensors_.size()));
  if (is_new) {
    sensors_.push_back({});
    sensors_.back().label = reading.label;
    sensors_.back().kind = reading.kind;
  }
  return it->second;
}

void Localizer::observe(const Reading& reading) {
  if (models_.find(reading.kind) == models_.end()) return;
  if (heard_ > 0 && std::abs(reading.time_s - instant_[0].reading.time_s) > kInstant_s) completeInstant();
  if (heard_ == instant_.size()) instant_.emplace_back();
  Heard& heard = instant_[heard_++];
  heard.reading = reading;
  heard.stream = streamOf(reading);
}

/// A gyro's rate first, as it is part of the motion that the odometry closes; measurements last.
void Localizer::completeInstant() {
  const auto begin = instant_.begin(), end = begin + static_cast<std::ptrdiff_t>(heard_);
  std::stable_sort(begin, end, [](const Heard& a, const Heard& b) {
    return std::tie(a.reading.kind, a.reading.label) < std::tie(b.reading.kind, b.reading.label);
  });
  const auto wheels = std::find_if(begin, end, [](const Heard& h) { return h.reading.kind == SensorKind::kOdometry; });
  for (auto h = begin; h != end; ++h) {
    if (wheels != end) h->reading.time_s = wheels->reading.time_s;
    h->says.measurements.clear();
    h->says = {nullptr, std::nullopt, std::move(h->says.measurements), 1, nullptr};
    models_.at(h->reading.kind)->interpret(h->reading, h->says);
    auto& u = use(h->stream);
    u.read += h->says.read;
    if (h->says.refused) refuse(h->stream, h->says.refused);
    if (h->says.yaw_rate) {
      motion_.addYawRate(h->reading.time_s, *h->says.yaw_rate);
      if (h->says.measurements.empty()) ++u.used;
    }
  }
  for (auto h = begin; h != end; ++h)
    if (h->says.wheels) motion(*h);
  if (setup_.joins_instants && started_) joinInstant();
  for (auto h = begin; h != end; ++h) measurements(*h);
  heard_ = 0;
}

/// (3.14): the heading goes with the fix.
void Localizer::joinInstant() {
  Measurement *heading = nullptr, *fix = nullptr;
  std::vector<Measurement>* headings = nullptr;
  for (size_t i = 0; i < heard_; ++i)
    for (auto& m : instant_[i].says.measurements) {
      if (m.kind == Measurement::Kind::kPosition) fix = &m;
      if (m.kind == Measurement::Kind::kHeading) heading = &m, headings = &instant_[i].says.measurements;
    }
  if (heading == nullptr || fix == nullptr) return;
  fix->kind = Measurement::Kind::kPositionHeading;
  fix->z(2) = heading->z(0);
  fix->R(2, 2) = heading->R(0, 0);
  fix->heading_has_offset = heading->heading_has_offset;
  headings->clear();
}

void Localizer::measurements(Heard& heard) {
  for (auto& m : heard.says.measurements) {
    m.stream = heard.stream;
    if (m.tellsPosition()) fixes_.push_back({m.z.x(), m.z.y()});
    add(m);
  }
}

void Localizer::motion(const Heard& heard) {
  const int stream = heard.stream;
  const double time_s = heard.reading.time_s;
  start_.begin(time_s);
  const uint64_t index = odometry_count_++;
  if (index == 0) first_odometry_s_ = time_s;
  const auto step = motion_.addOdometry(time_s, *heard.says.wheels);
  if (!step) {
    if (index > 0) refuse(stream, "no_increment");
    tryStart(false);
    if (started_ && time_s > now_s_ + 1e-9) {
      coastTo(time_s);
      scheduleEstimate(index);
    }
    return;
  }
  ++use(stream).used;
  if (!started_) {
    waiting_.push_back({*step, index});
    odometry_pose_ = odometry_pose_ + step->T_from_to;
    start_.track(time_s, odometry_pose_);
    tryStart(false);
    return;
  }
  emitEstimate();
  odometry_pose_ = odometry_pose_ + step->T_from_to;
  if (step->to_s <= now_s_) return;  // all of it was coasted already
  if (step->from_s > now_s_ + 1e-9) coastTo(step->from_s);
  MotionStep motion = step->motion;
  gapNoise(motion);
  advanceTo(step->to_s, motion.part(std::min(1.0, (step->to_s - now_s_) / motion.dt_s)));
  if (step->resting_rate) addStill(*step, stream);
  scheduleEstimate(index);
}

void Localizer::gapNoise(MotionStep& motion) const {
  const double gap = motion.dt_s;
  if (gap <= params_.of<OdometryParams>().gap_s) return;
  motion.turn_var += std::min(M_PI * M_PI, std::pow(params_.coast_turn_accel * gap, 2));
  motion.distance_var +=
      std::pow(0.1 * motion.distance_m, 2) + std::pow(params_.of<OdometryParams>().still_speed * gap, 2);
}

void Localizer::addStill(const MotionSource::Step& step, int stream) {
  Event e;
  e.is_motion = false;
  e.counted = true;  // no measurement of the log
  e.time_s = now_s_;
  e.measurement.kind = Measurement::Kind::kStill;
  e.measurement.time_s = now_s_;
  e.measurement.stream = stream;
  e.measurement.z(0) = *step.resting_rate;
  e.measurement.R(0, 0) =
      params_.of<ImuParams>().yaw_rate_sd * params_.of<ImuParams>().yaw_rate_sd / std::max(step.motion.dt_s, 1e-3);
  append(std::move(e));
}

}  // namespace sidestep
