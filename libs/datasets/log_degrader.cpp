// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_degrader.h"

#include <mrpt/math/TPose2D.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/errors.h"
#include "core/random.h"
#include "datasets/log_jump.h"
#include "datasets/log_reader.h"
#include "datasets/planar_reading.h"

namespace sidestep {
namespace {

std::shared_ptr<mrpt::obs::CObservation> copyOf(const mrpt::obs::CObservation& observation) {
  return std::dynamic_pointer_cast<mrpt::obs::CObservation>(observation.duplicateGetSmartPtr());
}

/// One event at work.
class Event {
 public:
  Event(std::string name, const DegradeEvent& event, uint64_t seed, uint64_t stream)
      : event_(event), random_(seed, stream), count_{std::move(name)} {}

  const DegradeEvent& params() const { return event_; }
  const LogDegrader::EventCount& count() const { return count_; }
  bool concerns(const Reading& entry) const { return event_.label == entry.label || event_.label == word(entry.kind); }
  bool jumps() const { return event_.action == "jump"; }
  /// By how much later stamps have moved back; within the cut time stands still.
  double shift_s(double after_s) const {
    return jumps() ? std::max(0.0, std::min(after_s, event_.to_s) - event_.from_s) : 0;
  }
  /// Counts what is cut out, as met and hit.
  bool jump(double first_s, double logged_s, Reading& entry) {
    if (!jump_) jump_.emplace(first_s + event_.from_s, first_s + event_.to_s);
    if (jump_->apply(logged_s, entry)) return true;
    ++count_.met, ++count_.hit;
    return false;
  }
  void leave() { held_.clear(); }  ///< freezing begins anew the next time

  /// @return false if the entry is lost.
  bool apply(Reading& entry) {
    ++count_.met;
    const uint64_t before = count_.hit++;  // unless the action says that it let this one pass
    if (event_.action == "drop") return random_.uniform() >= event_.probability ? passed(before) : drop(entry, before);
    if (event_.action == "thin")
      return (count_.met - 1) % static_cast<uint64_t>(event_.keep_every) == 0 && passed(before);
    if (event_.action == "delay") return delay(entry);
    if (event_.action == "freeze") return freeze(entry, before);
    if (event_.action == "spike" && random_.uniform() >= event_.probability) return passed(before);
    return change(entry);
  }

 private:
  bool passed(uint64_t hits) {
    count_.hit = hits;
    return true;
  }
  bool wants(const char* component) const { return event_.components == "all" || event_.components == component; }

  bool drop(Reading& entry, uint64_t before) {
    if (event_.components == "all") return false;
    const PlanarReading had = readPlanar(*entry.observation);
    requirePart(had, entry);
    const bool theta = event_.components == "theta", rate = event_.components == "rate";
    if (!(theta ? had.has_theta : rate ? had.has_rate : had.has_xy)) return passed(before);
    auto copy = copyOf(*entry.observation);
    const bool cut = theta ? removeTheta(*copy) : rate && removeRate(*copy);
    if (!cut && (had.has_theta + had.has_rate + had.has_xy) > 1)
      throw ConfigError("events." + count_.name + ": " + entry.label + " cannot lose " + event_.components +
                        " alone; components: all drops the observation");
    if (!readPlanar(*copy).any() || !cut) return false;
    entry.observation = copy;
    return true;
  }

  bool delay(Reading& entry) {
    entry.observation = copyOf(*entry.observation);
    entry.time_s += event_.delay_s;
    entry.observation->timestamp = mrpt::Clock::fromDouble(entry.time_s);
    return true;
  }

  bool freeze(Reading& entry, uint64_t before) {
    auto& held = held_[entry.label];
    if (!held) {
      held = entry.observation;
      return passed(before);
    }
    const auto fresh = entry.observation;
    entry.observation = copyOf(event_.components == "all" ? *held : *fresh);
    entry.observation->timestamp = fresh->timestamp;
    if (event_.components == "all") return true;
    const PlanarReading old = readPlanar(*held);
    requirePart(old, entry);
    PlanarReading now = readPlanar(*fresh);
    if (wants("xy")) now.x = old.x, now.y = old.y;
    if (wants("theta")) now.theta = old.theta;
    if (wants("rate")) now.rate = old.rate;
    writePlanar(now, *entry.observation);
    return true;
  }

  /// bias, spike, noise: something is added.
  bool change(Reading& entry) {
    PlanarReading now = readPlanar(*entry.observation);
    requirePart(now, entry);
    const double xy_sd = addedSd(event_.sd_m), direction = random_.uniform(-M_PI, M_PI);
    const double noise[4] = {random_.gaussian(), random_.gaussian(), random_.gaussian(), random_.gaussian()};
    const double side = std::copysign(1.0, direction);
    PlanarReading add;
    if (event_.action == "bias") add = {true, true, true, event_.x_m, event_.y_m, event_.theta, event_.rate};
    if (event_.action == "spike")
      add = {true,
             true,
             true,
             event_.spike_m * std::cos(direction),
             event_.spike_m * std::sin(direction),
             side * event_.spike_theta,
             0};
    if (event_.action == "noise")
      add = {true,
             true,
             true,
             xy_sd * noise[0],
             xy_sd * noise[1],
             addedSd(event_.sd_theta) * noise[2],
             addedSd(event_.sd_rate) * noise[3]};
    if (wants("xy")) now.x += add.x, now.y += add.y;
    if (wants("theta")) now.theta = mrpt::math::wrapToPi(now.theta + add.theta);
    if (wants("rate")) now.rate += add.rate;
    entry.observation = copyOf(*entry.observation);
    writePlanar(now, *entry.observation);
    return true;
  }

  /// What makes noise of `sd` `noise_scale` times as large: variances add up.
  double addedSd(double sd) const { return sd * std::sqrt(event_.noise_scale * event_.noise_scale - 1); }

  void requirePart(const PlanarReading& reading, const Reading& entry) const {
    const bool whole = event_.components == "all";
    const bool there = whole ? reading.any() : true;
    if (there && (whole || knows(*entry.observation, reading))) return;
    throw ConfigError("events." + count_.name + ": " + event_.action + " cannot be done to " +
                      (whole ? std::string("the values") : event_.components) + " of " + entry.label + " (" +
                      entry.observation->GetRuntimeClass()->className + "), which has none");
  }
  /// Whether the class has that part at all; an IMU may be without heading for a while.
  bool knows(const mrpt::obs::CObservation& observation, const PlanarReading& reading) const {
    const std::string name = observation.GetRuntimeClass()->className;
    const bool imu = name.find("CObservationIMU") != std::string::npos;
    if (event_.components == "xy") return reading.has_xy;
    return imu || (event_.components == "theta" ? reading.has_theta : reading.has_rate);
  }

  DegradeEvent event_;
  Random random_;
  LogDegrader::EventCount count_;
  std::map<std::string, std::shared_ptr<mrpt::obs::CObservation>> held_;
  std::optional<LogJump> jump_;
};

}  // namespace

struct LogDegrader::Impl {
  Impl(const DegradeScript& s, Sink out) : script(s), sink(std::move(out)) {
    script.check();
    for (size_t i = 0; i < script.event_names.size(); ++i)
      events.emplace_back(script.event_names[i], script.events.at(script.event_names[i]),
                          static_cast<uint64_t>(script.seed), i);
  }

  DegradeScript script;
  Sink sink;
  std::vector<Event> events;
  std::multimap<double, Reading> delayed;
  std::optional<double> first_s;
  std::optional<mrpt::math::TPose2D> truth, odometry;

  void track(const Reading& entry) {
    if (entry.kind != SensorKind::kGroundTruth && entry.kind != SensorKind::kOdometry) return;
    const PlanarReading r = readPlanar(*entry.observation);
    const mrpt::math::TPose2D pose(r.x, r.y, r.theta);
    if (entry.kind == SensorKind::kGroundTruth) truth = pose;
    if (entry.kind == SensorKind::kOdometry)
      odometry = mrpt::math::TPose2D(script.start_x_m, script.start_y_m, script.start_yaw) + pose;
  }

  bool within(const DegradeEvent& e, double after_s) const {
    if (after_s < e.from_s || after_s >= e.to_s) return false;
    if (e.zone.empty()) return true;
    const auto& pose = script.pose_from == "truth" || (script.pose_from == "auto" && truth) ? truth : odometry;
    return pose && script.zones.at(e.zone).contains({pose->x, pose->y});
  }

  void release(double until_s) {
    while (!delayed.empty() && delayed.begin()->first <= until_s) {
      sink(delayed.begin()->second);
      delayed.erase(delayed.begin());
    }
  }
};

LogDegrader::LogDegrader(const DegradeScript& script, Sink sink)
    : impl_(std::make_unique<Impl>(script, std::move(sink))) {}

LogDegrader::~LogDegrader() = default;

void LogDegrader::push(const Reading& given) {
  if (!impl_->first_s) impl_->first_s = given.time_s;
  const double first_s = *impl_->first_s, after_s = given.time_s - first_s;
  double now_s = given.time_s;  // as stamped once what is cut out is gone
  for (const Event& event : impl_->events) now_s -= event.shift_s(after_s);
  impl_->release(now_s);
  impl_->track(given);
  Reading entry = given;
  for (Event& event : impl_->events) {
    if (event.jumps()) {
      if (!event.jump(first_s, given.time_s, entry)) return;
      continue;
    }
    if (!event.concerns(entry)) continue;
    if (!impl_->within(event.params(), after_s))
      event.leave();
    else if (!event.apply(entry))
      return;
  }
  if (entry.time_s > now_s)
    impl_->delayed.emplace(entry.time_s, entry);
  else
    impl_->sink(entry);
}

void LogDegrader::finish() { impl_->release(std::numeric_limits<double>::infinity()); }

std::vector<LogDegrader::EventCount> LogDegrader::counts() const {
  std::vector<EventCount> out;
  for (const Event& event : impl_->events) out.push_back(event.count());
  return out;
}

}  // namespace sidestep
