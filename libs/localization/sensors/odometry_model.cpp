// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/sensors/odometry_model.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CObservationOdometry.h>

#include <cmath>

#include "core/errors.h"
#include "core/kinematics.h"

namespace sidestep {
namespace {

/// Arc and turn as a displacement (2.1), the chord at half the turn.
mrpt::math::TPose2D arc(const BodyMotion& motion) { return alongChord({}, motion.ahead, motion.turn); }

}  // namespace

void OdometryParams::visit(ParamVisitor& v) {
  v.choice("source", source, {"auto", "pose", "velocity", "ticks"}, "what of an odometry observation to use");
  v.number("ticks_left_m", ticks_left_m, {0, 1}, "m", "travel of the left wheel in one tick");
  v.number("ticks_right_m", ticks_right_m, {0, 1}, "m", "travel of the right wheel in one tick");
  v.number("track_m", track_m, {0, 10}, "m", "distance L between the wheels (2.2)");
  v.number("scale", scale, {0.5, 2}, "", "true distance by odometry's distance, where calibration has shown one");
  v.number("gap_s", gap_s, {0.01, 1e6}, "s", "odometry missing for longer than this counts as a gap");
  v.number("jump_speed", jump_speed, {0.1, 1e4}, "m/s", "an increment faster than this is a restarted odometry");
  v.number("still_speed", still_speed, {0, 1}, "m/s", "slower than this, and");
  v.number("still_turn_rate", still_turn_rate, {0, 1}, "rad/s", "turning slower than this, the robot stands");
  v.section("noise", "(3.2), (3.6)", [this](ParamVisitor& w) { noise.visit(w); });
}

void OdometryParams::check() const {
  if (source == "ticks" && !(ticks_left_m > 0 && ticks_right_m > 0 && track_m > 0))
    throw ConfigError("odometry.source: ticks needs odometry.ticks_left_m, ticks_right_m and track_m above 0");
}

OdometryModel::OdometryModel(const OdometryParams& params) : params_(params) { params_.check(); }

OdometryModel::Reading OdometryModel::read(double time_s, const mrpt::obs::CObservationOdometry& o) {
  return {time_s,
          o.odometry.asTPose(),
          o.hasVelocities,
          o.hasEncodersInfo,
          o.velocityLocal,
          static_cast<double>(o.encoderLeftTicks),
          static_cast<double>(o.encoderRightTicks)};
}

OdometryModel::Source OdometryModel::pickSource(const Reading& now) const {
  if (params_.source == "pose") return Source::kPose;
  if (params_.source == "velocity") return Source::kVelocity;
  if (params_.source == "ticks") return Source::kTicks;
  if (poses_move_) return Source::kPose;
  if (now.has_ticks && params_.track_m > 0 && params_.ticks_left_m > 0) return Source::kTicks;
  return now.has_velocity ? Source::kVelocity : Source::kPose;
}

mrpt::math::TPose2D OdometryModel::displacement(const Reading& now, Source source) const {
  const double dt = now.time_s - last_->time_s;
  if (source == Source::kVelocity)
    return arc(
        {0.5 * (last_->velocity.vx + now.velocity.vx) * dt, 0.5 * (last_->velocity.omega + now.velocity.omega) * dt});
  if (source == Source::kTicks) {  // (2.2)
    const double left = (now.left_ticks - last_->left_ticks) * params_.ticks_left_m;
    const double right = (now.right_ticks - last_->right_ticks) * params_.ticks_right_m;
    return arc(bodyOf({left, right}, params_.track_m));
  }
  const double c = std::cos(last_->pose.phi), s = std::sin(last_->pose.phi);
  const double dx = now.pose.x - last_->pose.x, dy = now.pose.y - last_->pose.y;
  return {c * dx + s * dy, -s * dx + c * dy, mrpt::math::wrapToPi(now.pose.phi - last_->pose.phi)};
}

std::optional<OdometryIncrement> OdometryModel::advance(double time_s, const mrpt::obs::CObservationOdometry& o) {
  const Reading now = read(time_s, o);
  if (!last_) {
    last_ = now;
    return std::nullopt;
  }
  const double dt = now.time_s - last_->time_s;
  if (!(dt > 0)) return std::nullopt;
  const double moved_by = std::abs(now.pose.x - last_->pose.x) + std::abs(now.pose.y - last_->pose.y) +
                          std::abs(now.pose.phi - last_->pose.phi);
  poses_move_ = poses_move_ || (moved_by > 0 && std::isfinite(moved_by));
  auto d = displacement(now, pickSource(now));
  const double from = last_->time_s;
  last_ = now;
  d.x *= params_.scale;
  d.y *= params_.scale;
  const double chord = std::hypot(d.x, d.y);
  if (!(chord <= params_.jump_speed * dt) || !std::isfinite(d.phi)) {
    ++jumps_;
    return std::nullopt;
  }
  OdometryIncrement out;
  out.from_s = from;
  out.to_s = time_s;
  out.T_from_to = d;
  out.step.dt_s = dt;
  out.step.distance_m = std::copysign(chord, d.x * std::cos(0.5 * d.phi) + d.y * std::sin(0.5 * d.phi));
  out.step.turn_rad = d.phi;
  out.step.still = chord <= params_.still_speed * dt && std::abs(d.phi) <= params_.still_turn_rate * dt;
  params_.noise.apply(out.step);
  return out;
}

}  // namespace sidestep
