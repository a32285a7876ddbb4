// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/localizer.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

#include "localization/sensors/imu.h"
#include "localization/sensors/odometry.h"

namespace sidestep {
void LocalizerParams::visit(ParamVisitor& v) {
  v.number("late_window_s", late_window_s, {0, 60}, "s", "measurements up to this late are put where they belong");
  v.number("coast_after_s", coast_after_s, {0.01, 1e6}, "s", "odometry missing for this long is replaced by coasting");
  v.number("coast_accel", coast_accel, {0, 100}, "m/s^2", "acceleration that coasting must allow for");
  v.number("coast_turn_accel", coast_turn_accel, {0, 100}, "rad/s^2", "turning acceleration that it must allow for");
  v.flag("zero_velocity", zero_velocity, "wheels at rest mean that the robot stands, and that the gyro shows its bias");
  v.section("start", "where the robot starts", [this](ParamVisitor& w) { start.visit(w); });
  sensors.visit(v);
}

Localizer::Localizer(const LocalizerParams& params, std::unique_ptr<PoseFilter> filter, const LocalizerSetup& setup)
    : params_(params),
      filter_(std::move(filter)),
      motion_(params.of<OdometryParams>(), params.of<ImuParams>(), params.zero_velocity),
      setup_(setup),
      start_(params.start, setup.start.positions, setup.start.heading, setup.start.heading_offset_sd) {
  for (const auto& row : sidestep::sensors()) {
    const auto& used = setup.sensors;
    if (used.empty() || std::find(used.begin(), used.end(), row.kind) != used.end())
      models_[row.kind] = row.make(params.sensors);
  }
}

Localizer::~Localizer() = default;
Localizer::Localizer(Localizer&&) noexcept = default;

void Localizer::refuse(int stream, const char* reason) { ++use(stream).refused[reason]; }

// ---- placing in time ----

void Localizer::add(const Measurement& m) {
  if (!started_) {
    start_.begin(m.time_s);
    if (m.kind == Measurement::Kind::kPosition) start_.fix(m);
    if (m.kind == Measurement::Kind::kHeading) start_.heading(m);
    pending_.insert(std::upper_bound(pending_.begin(), pending_.end(), m,
                                     [](const auto& a, const auto& b) { return a.time_s < b.time_s; }),
                    m);
    tryStart(false);
    return;
  }
  place(m);
}

void Localizer::place(const Measurement& m) {
  if (m.time_s <= now_s_) return insertOutOfSequence(m);
  pending_.insert(std::upper_bound(pending_.begin(), pending_.end(), m,
                                   [](const auto& a, const auto& b) { return a.time_s < b.time_s; }),
                  m);
  if (m.time_s > now_s_ + params_.coast_after_s) {
    coastTo(m.time_s);
    scheduleEstimate(std::nullopt);
  }
}

void Localizer::insertOutOfSequence(const Measurement& m) {
  if (m.time_s < base_time_s_)
    return refuse(m.stream, m.time_s < now_s_ - params_.late_window_s ? "too_late" : "before_start");
  size_t i = history_.size();
  while (i > 0 && history_[i - 1].time_s > m.time_s) --i;
  Event e;
  e.is_motion = false;
  e.time_s = m.time_s;
  e.measurement = m;
  const bool splits = i < history_.size() && history_[i].is_motion && history_[i].motion.dt_s > 0;
  if (splits) {
    Event before;
    before.time_s = m.time_s;
    const double left = history_[i].time_s - m.time_s, whole = history_[i].motion.dt_s;
    before.motion = history_[i].motion.part(std::clamp(1 - left / whole, 0.0, 1.0));
    history_[i].motion = history_[i].motion.part(std::clamp(left / whole, 0.0, 1.0));
    history_.insert(history_.begin() + static_cast<std::ptrdiff_t>(i), std::move(before));
    history_.insert(history_.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(e));
  } else {
    history_.insert(history_.begin() + static_cast<std::ptrdiff_t>(i), std::move(e));
  }
  replayFrom(i);
}

void Localizer::advanceTo(double time_s, const MotionStep& step) {
  emitEstimate();
  MotionStep rest = step;
  while (!pending_.empty() && pending_.front().time_s <= time_s) {
    const Measurement m = pending_.front();
    pending_.erase(pending_.begin());
    if (m.time_s > now_s_) {
      const double fraction = (m.time_s - now_s_) / (time_s - now_s_);
      appendMotion(m.time_s, rest.part(fraction));
      rest = rest.part(1 - fraction);
    }
    Event e;
    e.is_motion = false;
    e.time_s = now_s_;
    e.measurement = m;
    append(std::move(e));
  }
  if (time_s > now_s_) appendMotion(time_s, rest);
  last_motion_ = step;
  trimHistory();
}

void Localizer::appendMotion(double time_s, const MotionStep& step) {
  Event e;
  e.time_s = time_s;
  e.motion = step;
  append(std::move(e));
  now_s_ = time_s;
}

void Localizer::append(Event&& event) {
  if (!spare_states_.empty()) {
    event.state_after = std::move(spare_states_.back());
    spare_states_.pop_back();
  }
  history_.push_back(std::move(event));
  apply(history_.back());
}

void Localizer::apply(Event& event) {
  if (event.is_motion) {
    filter_->predict(event.motion);
  } else {
    const Correction c = filter_->correct(event.measurement);
    event.opened = c.reason == Correction::Reason::kReset ? c.nis / c.dof : 1;
    count(event, c);
  }
  filter_->save(event.state_after);
}

void Localizer::replayFrom(size_t index) {
  filter_->restore(index == 0 ? base_state_ : history_[index - 1].state_after);
  for (size_t i = index; i < history_.size(); ++i) apply(history_[i]);
}

void Localizer::count(Event& event, const Correction& c) {
  if (event.counted) return;
  event.counted = true;
  auto& u = use(event.measurement.stream);
  if (c.dof > 0 && c.reason != Correction::Reason::kNotFinite) {
    u.nis_dof = c.dof;
    if (records_innovations_)
      innovations_.push_back({event.measurement.stream, event.time_s, c.nis_single, c.dof, c.accepted()});
    if (c.accepted()) {
      u.nis_sum += c.nis_single;
      ++u.nis_count;
      // Squares of errors that are alike over tau are alike over tau / 2: of n in a time T, T / tau count; raised is 2
      // tau n / T.
      u.nis_independent += std::min(1.0, 2 / event.measurement.covariance_inflation);
    }
  }
  if (c.accepted())
    ++u.used;
  else
    ++u.refused[word(c.reason)];
}

void Localizer::coastTo(double time_s) {
  MotionStep coast;
  coast.dt_s = time_s - now_s_;
  const double fading = last_motion_.dt_s > 0 ? std::min(coast.dt_s, params_.coast_after_s) / last_motion_.dt_s : 0;
  coast.distance_m = last_motion_.distance_m * fading;
  coast.turn_rad = last_motion_.turn_rad * fading;
  coast.distance_var = std::pow(0.5 * params_.coast_accel * coast.dt_s * coast.dt_s, 2);
  coast.turn_var = std::min(M_PI * M_PI, std::pow(0.5 * params_.coast_turn_accel * coast.dt_s * coast.dt_s, 2));
  const MotionStep before = last_motion_;
  advanceTo(time_s, coast);
  last_motion_ = before;
}

void Localizer::scheduleEstimate(std::optional<uint64_t> odometry_index) {
  scheduled_ = true;
  scheduled_index_ = odometry_index;
}

void Localizer::emitEstimate() {
  if (!scheduled_) return;
  scheduled_ = false;
  ready_.push_back({now_s_, filter_->estimate(), odometry_pose_, scheduled_index_, filter_->lostProbability(), {}});
  if (modes_period_s_ > 0 && now_s_ >= next_modes_s_) {
    ready_.back().modes = filter_->modes();
    next_modes_s_ = now_s_ + modes_period_s_;
  }
}

void Localizer::trimHistory() {
  while (history_.size() > 1 && history_.front().time_s < now_s_ - params_.late_window_s) {
    feedSmoother(history_.front());
    base_time_s_ = history_.front().time_s;
    std::swap(base_state_, history_.front().state_after);
    spare_states_.push_back(std::move(history_.front().state_after));
    history_.pop_front();
  }
}

void Localizer::feedSmoother(const Event& e) {
  if (!smoother_) return;
  if (e.is_motion)
    smoother_->motion(e.time_s, e.motion, e.state_after);
  else
    smoother_->correction(e.time_s, e.opened, e.state_after);
}

void Localizer::smooth() {
  std::vector<double> times_s;
  for (const auto& e : history_) feedSmoother(e);
  for (const auto& e : ready_) times_s.push_back(e.time_s);
  const auto beliefs = smoother_->beliefs(*filter_, times_s);
  for (size_t i = 0; i < ready_.size(); ++i) ready_[i].belief = beliefs[i];
  smoother_.reset();
}

// ---- the start ----

void Localizer::tryStart(bool last_chance) {
  if (started_) return;
  if (auto s = start_.solve(last_chance)) start(*s);
}

void Localizer::start(const StartBelief& s) {
  started_ = true;
  filter_->start(s.belief);
  now_s_ = base_time_s_ = s.time_s;
  filter_->save(base_state_);
  if (smoother_) smoother_->start(now_s_, base_state_);
  odometry_pose_ = s.belief.mean;
  const bool with_odometry = odometry_count_ > 0 && first_odometry_s_ == now_s_;
  scheduleEstimate(with_odometry ? std::optional<uint64_t>(0) : std::nullopt);
  for (const auto& [step, index] : waiting_) {
    if (step.from_s > now_s_ + 1e-9) {
      coastTo(step.from_s);
      scheduleEstimate(index - 1);
    }
    emitEstimate();
    odometry_pose_ = odometry_pose_ + step.T_from_to;
    advanceTo(step.to_s, step.motion);
    scheduleEstimate(index);
  }
  waiting_.clear();
  const auto rest = std::move(pending_);
  pending_.clear();
  for (const auto& m : rest) place(m);
}

void Localizer::finish() {
  completeInstant();
  tryStart(true);
  if (!started_) return;
  if (!pending_.empty()) {
    coastTo(pending_.back().time_s);
    scheduleEstimate(std::nullopt);
  }
  emitEstimate();
  if (smoother_) smooth();
}

std::vector<Estimate> Localizer::takeEstimates() {
  std::vector<Estimate> out;
  if (!smoother_) out.swap(ready_);
  return out;
}

std::vector<InnovationRecord> Localizer::takeInnovations() {
  std::vector<InnovationRecord> out;
  out.swap(innovations_);
  return out;
}

std::vector<mrpt::math::TPoint2D> Localizer::takeFixes() {
  std::vector<mrpt::math::TPoint2D> out;
  out.swap(fixes_);
  return out;
}

}  // namespace sidestep
