// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/localization_scenario.h"

#include <mrpt/math/wrap2pi.h>

#include <cmath>

#include "core/errors.h"
#include "core/kinematics.h"

namespace sidestep {
namespace {

enum Stream : uint64_t { kEncoders = 1, kImu = 2, kGps = 3 };

/// (2.3)-(2.4): along the chord at half the turn.
void deadReckon(OdometrySample& odometry) {
  auto& p = odometry.pose;
  p = alongChord(p, odometry.distance_m, odometry.turn_rad);
  p.phi = mrpt::math::wrapToPi(p.phi);
}

}  // namespace

void OutageParams::visit(ParamVisitor& v) {
  v.number("from_s", from_s, {0, 1e5}, "s", "begins");
  v.number("to_s", to_s, {0, 1e5}, "s", "ends");
  v.choice("loses", loses, {"none", "theta", "xy", "all"}, "what is not received meanwhile: heading, fixes, both");
}

void LocalizationScenarioParams::visit(ParamVisitor& v) {
  v.section("trajectory", "the true motion", [this](ParamVisitor& w) { trajectory.visit(w); });
  v.section("encoders", "what the wheels say of it", [this](ParamVisitor& w) { encoders.visit(w); });
  v.section("imu", "what the IMU says", [this](ParamVisitor& w) { imu.visit(w); });
  v.section("gps", "what the GPS says", [this](ParamVisitor& w) { gps.visit(w); });
  v.section("roof", "a stretch in which signals are missing", [this](ParamVisitor& w) { roof.visit(w); });
}

void LocalizationScenarioParams::check() const {
  trajectory.check();
  const double fastest = 1 / trajectory.step_s * (1 + 1e-6);
  if (imu.rate_hz > fastest || gps.rate_hz > fastest)
    throw ConfigError(std::string(imu.rate_hz > fastest ? "imu" : "gps") +
                      ".rate_hz: faster than one reading a step; " + "make trajectory.step_s shorter");
  if (roof.to_s < roof.from_s) throw ConfigError("roof.to_s: lies before roof.from_s");
}

SensorStream::SensorStream(const LocalizationScenario& scenario, uint64_t seed)
    : scenario_(&scenario),
      encoders_(scenario.params().encoders, Random(seed, kEncoders)),
      imu_(scenario.params().imu, Random(seed, kImu)),
      gps_(scenario.params().gps, Random(seed, kGps)) {}

bool SensorStream::next(SensorStep& out) {
  const auto& truth = scenario_->truth();
  if (k_ >= truth.size()) return false;
  const TruthSample& now = truth[k_];
  out.imu.reset();
  out.gps.reset();
  out.time_s = now.time_s;
  out.truth = now;
  if (k_ == 0) {
    out.odometry = {};
    ++k_;
    return true;
  }
  const double dt = now.time_s - truth[k_ - 1].time_s;
  const auto wheels = encoders_.step(dt, now.distance_m, now.turn_rad);
  out.odometry = {dt,
                  wheels.distance_m,
                  wheels.turn_rad,
                  wheels.distance_m / dt,
                  wheels.turn_rad / dt,
                  wheels.left_ticks,
                  wheels.right_ticks,
                  odometry_pose_};
  deadReckon(out.odometry);
  odometry_pose_ = out.odometry.pose;
  const OutageParams& roof = scenario_->params().roof;
  // A reading that is lost is drawn all the same: what comes after does not depend on what is lost.
  if (imu_.due(now.time_s)) {
    const auto r = imu_.read(now.time_s, now.pose.phi, now.w);
    out.imu = {!roof.losesHeading(now.time_s), r.yaw, r.yaw_rate};
  }
  if (gps_.due(now.time_s)) {
    const auto r = gps_.read(now.time_s, now.pose.x, now.pose.y);
    if (!roof.losesPosition(now.time_s) && !gps_.inOutage(now.time_s)) out.gps = {r.x, r.y};
  }
  ++k_;
  return true;
}

LocalizationScenario::LocalizationScenario(const LocalizationScenarioParams& params) : params_(params) {
  params_.check();
  truth_ = sampleTrajectory(params_.trajectory);
}

std::vector<SensorStep> LocalizationScenario::generate(uint64_t seed) const {
  std::vector<SensorStep> out(truth_.size());
  auto stream = run(seed);
  for (auto& step : out) stream.next(step);
  return out;
}

}  // namespace sidestep
