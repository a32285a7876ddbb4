// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "perception/motion_predictor.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

void MotionPredictorParams::visit(ParamVisitor& v) {
  v.number("accel_noise", accel_noise, {0, 100}, "m^2/s^3", "spectral density of the obstacles' acceleration");
  v.number("velocity_sd", velocity_sd, {0.01, 100}, "m/s", "standard deviation of a newcomer's velocity");
  v.number("forget_after_s", forget_after_s, {0, 1000}, "s", "an obstacle not seen for this long is forgotten");
  v.number("horizon_s", horizon_s, {0, 120}, "s", "how far obstacles are predicted");
  v.number("step_s", step_s, {0.05, 10}, "s", "time between predicted states");
}

MotionPredictor::Covariance MotionPredictor::ahead(const Covariance& P, double dt) const {
  const double q = params_.accel_noise;
  return {P.pp + 2 * dt * P.pv + dt * dt * P.vv + q * dt * dt * dt / 3, P.pv + dt * P.vv + q * dt * dt / 2,
          P.vv + q * dt};
}

void MotionPredictor::observe(double time_s, int id, const mrpt::math::TPoint2D& position, double position_sd,
                              double radius_m) {
  if (!std::isfinite(time_s + position.x + position.y + position_sd + radius_m)) return;
  const auto at = std::lower_bound(tracks_.begin(), tracks_.end(), id, [](const Track& t, int i) { return t.id < i; });
  const double R = std::max(position_sd * position_sd, 1e-8);
  if (at == tracks_.end() || at->id != id) {
    Track fresh{id, time_s, radius_m, position, {0, 0}, {R, 0, params_.velocity_sd * params_.velocity_sd}};
    tracks_.insert(at, fresh);
    return;
  }
  const double dt = time_s - at->time_s;
  if (dt < 0) return;
  const Covariance P = ahead(at->P, dt);
  const double kp = P.pp / (P.pp + R), kv = P.pv / (P.pp + R);
  const auto off = position - (at->position + at->velocity * dt);
  at->position = position - off * (1 - kp);
  at->velocity = at->velocity + off * kv;
  at->P = {(1 - kp) * P.pp, (1 - kp) * P.pv, P.vv - kv * P.pv};
  at->time_s = time_s;
  at->radius_m = radius_m;
}

void MotionPredictor::predict(double time_s, std::vector<MovingObstacle>& out) {
  std::erase_if(tracks_, [&](const Track& t) { return time_s - t.time_s > params_.forget_after_s; });
  out.resize(tracks_.size());
  for (size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    MovingObstacle& o = out[i];
    const double since = std::max(time_s - track.time_s, 0.0);
    const auto stateAt = [&](double after) -> PredictedState {
      const double P = ahead(track.P, since + after).pp;
      return {after, track.position + track.velocity * (since + after), Eigen::Vector2d(P, P).asDiagonal()};
    };
    const PredictedState now = stateAt(0);
    o.id = track.id;
    o.position = now.position;
    o.velocity = track.velocity;
    o.radius_m = track.radius_m;
    o.covariance = now.covariance;
    o.predicted.clear();
    for (int k = 1; k * params_.step_s <= params_.horizon_s; ++k) o.predicted.push_back(stateAt(k * params_.step_s));
  }
}

}  // namespace sidestep
