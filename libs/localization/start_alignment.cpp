// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/start_alignment.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <cmath>

namespace sidestep {
void StartParams::visit(ParamVisitor& v) {
  v.flag("pose_given", pose_given, "the robot starts at the pose below; else it is found from fixes, or is the origin");
  v.number("x_m", x_m, {-1e7, 1e7}, "m", "start");
  v.number("y_m", y_m, {-1e7, 1e7}, "m", "start");
  v.angle("yaw_deg", yaw, {-360, 360}, "start, counter-clockwise from east");
  v.number("position_sd_m", position_sd_m, {0, 1e6}, "m", "how well that position is known");
  v.angle("yaw_sd_deg", yaw_sd, {0, 360}, "how well that heading is known");
  v.number("align_distance_m", align_distance_m, {0.1, 10000}, "m",
           "how far the robot must have gone before fixes tell its heading");
  v.number("heading_wait_s", heading_wait_s, {0, 1000}, "s", "wait this long for the IMU's first heading");
  v.number("align_time_s", align_time_s, {0.1, 100000}, "s", "start with what is known after this long");
}

StartAlignment::StartAlignment(const StartParams& params, bool expect_positions, bool expect_heading,
                               double heading_offset_sd)
    : params_(params),
      expect_positions_(expect_positions),
      expect_heading_(expect_heading),
      heading_offset_sd_(heading_offset_sd) {}

void StartAlignment::begin(double time_s) {
  if (!begin_s_) begin_s_ = now_s_ = time_s;
}

void StartAlignment::track(double time_s, const mrpt::math::TPose2D& T_start_base) {
  now_s_ = time_s;
  T_start_base_ = T_start_base;
}

void StartAlignment::fix(const Measurement& m) {
  if (!m.z.allFinite() || !m.R.allFinite()) return;
  const auto lever =
      mrpt::math::TPose2D(0, 0, T_start_base_.phi).composePoint({m.p_base_sensor.x(), m.p_base_sensor.y()});
  if (pairs_.size() < 5000)
    pairs_.push_back({{T_start_base_.x + lever.x, T_start_base_.y + lever.y}, {m.z.x(), m.z.y()}, m.R(0, 0)});
}

void StartAlignment::heading(const Measurement& m) {
  if (heading_ || !m.z.allFinite() || !m.R.allFinite()) return;
  heading_ = m.z(0);
  heading_var_ = m.R(0, 0);
  heading_track_ = T_start_base_;
}

PoseBelief StartAlignment::given() const {
  PoseBelief b;
  b.mean = {params_.x_m, params_.y_m, params_.yaw};
  const double p = params_.position_sd_m * params_.position_sd_m;
  b.covariance.diagonal() << p, p, params_.yaw_sd * params_.yaw_sd;
  return b;
}

/// The origin is where the robot starts; if the IMU tells a heading, its frame is the map's.
PoseBelief StartAlignment::atOrigin() const {
  PoseBelief b = given();
  if (!heading_) return b;
  b.mean.phi = mrpt::math::wrapToPi(*heading_ - heading_track_->phi);
  b.covariance(2, 2) = heading_var_;
  return b;
}

std::optional<PoseBelief> StartAlignment::fromHeading() const {
  if (!heading_ || pairs_.empty() || heading_offset_sd_ > 0.6) return std::nullopt;
  PoseBelief b;
  b.mean.phi = mrpt::math::wrapToPi(*heading_ - heading_track_->phi);
  const auto ahead = mrpt::math::TPose2D(0, 0, b.mean.phi).composePoint(pairs_.front().track);
  b.mean.x = pairs_.front().fix.x - ahead.x;
  b.mean.y = pairs_.front().fix.y - ahead.y;
  const double v = pairs_.front().variance;
  b.covariance.diagonal() << v, v, heading_var_ + heading_offset_sd_ * heading_offset_sd_;
  return b;
}

std::optional<PoseBelief> StartAlignment::fromTrack(bool last_chance) const {
  if (pairs_.empty()) return std::nullopt;
  const double n = static_cast<double>(pairs_.size());
  mrpt::math::TPoint2D a{0, 0}, b{0, 0};
  for (const auto& p : pairs_) {
    a += p.track * (1 / n);
    b += p.fix * (1 / n);
  }
  double dot = 0, cross = 0, spread = 0;
  for (const auto& p : pairs_) {
    const auto u = p.track - a, w = p.fix - b;
    dot += u.x * w.x + u.y * w.y;
    cross += u.x * w.y - u.y * w.x;
    spread += u.x * u.x + u.y * u.y;
  }
  const double reach = 2 * std::sqrt(spread / n), sd = std::sqrt(pairs_.front().variance);
  const double wanted = std::max(params_.align_distance_m, 4 * std::min(sd, params_.align_distance_m));
  if (!last_chance && (pairs_.size() < 3 || reach < wanted)) return std::nullopt;
  PoseBelief out;
  out.mean.phi = dot * dot + cross * cross > 0 ? std::atan2(cross, dot) : 0;
  const auto turned = mrpt::math::TPose2D(0, 0, out.mean.phi).composePoint(a);
  out.mean.x = b.x - turned.x;
  out.mean.y = b.y - turned.y;
  // Errors of nearby fixes are alike, so that n of them are taken to be worth two.
  const double yaw_sd = std::min(M_PI, reach > 0 ? std::sqrt(2.0) * sd / reach : M_PI);
  out.covariance.diagonal() << sd * sd, sd * sd, yaw_sd * yaw_sd;
  return out;
}

std::optional<StartBelief> StartAlignment::solve(bool last_chance) const {
  if (!begin_s_) return std::nullopt;
  if (params_.pose_given) return StartBelief{*begin_s_, given()};
  if (!expect_positions_) {
    const bool wait = expect_heading_ && !heading_ && !last_chance && now_s_ - *begin_s_ < params_.heading_wait_s;
    return wait ? std::nullopt : std::optional(StartBelief{*begin_s_, atOrigin()});
  }
  const bool timeout = last_chance || now_s_ - *begin_s_ > params_.align_time_s;
  if (auto b = fromHeading()) return StartBelief{*begin_s_, *b};
  if (auto b = fromTrack(timeout)) return StartBelief{*begin_s_, *b};
  if (timeout) return StartBelief{*begin_s_, atOrigin()};
  return std::nullopt;
}

}  // namespace sidestep
