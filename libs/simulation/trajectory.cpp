// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/trajectory.h"

#include <mrpt/math/wrap2pi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/errors.h"

namespace sidestep {
namespace {

/// v, w and the integral of w, as functions of time.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual double v(double t) const = 0;
  virtual double w(double t) const = 0;
  /// Heading at t less that at 0 [rad].
  virtual double turned(double t) const = 0;
  /// Way from 0 to t [m].
  virtual double travelled(double t) const = 0;
  /// Instants at which v or w have a corner, in order.
  virtual std::vector<double> corners() const { return {}; }
};

class Sinusoid final : public Motion {
 public:
  Sinusoid(double v, double mean, double amplitude, double frequency, double phase)
      : v_(v), mean_(mean), amplitude_(amplitude), frequency_(frequency), phase_(phase) {}
  double v(double) const override { return v_; }
  double w(double t) const override { return mean_ + amplitude_ * std::sin(frequency_ * t + phase_); }
  double turned(double t) const override {
    return mean_ * t - amplitude_ / frequency_ * (std::cos(frequency_ * t + phase_) - std::cos(phase_));
  }
  double travelled(double t) const override { return v_ * t; }

 private:
  double v_, mean_, amplitude_, frequency_, phase_;
};

class Profile final : public Motion {
 public:
  explicit Profile(const Table& rows) {
    for (const auto& row : rows) add(row[0], row[1], row[2]);
    const Knot at_start = {0, v(0), w(0), travelled(0), turned(0)};
    origin_ = at_start;
  }
  double v(double t) const override { return interpolated(t, &Knot::v); }
  double w(double t) const override { return interpolated(t, &Knot::w); }
  double turned(double t) const override { return integral(t, &Knot::w, &Knot::turned) - origin_.turned; }
  double travelled(double t) const override { return integral(t, &Knot::v, &Knot::travelled) - origin_.travelled; }
  std::vector<double> corners() const override {
    std::vector<double> out;
    for (const auto& k : knots_) out.push_back(k.t);
    return out;
  }

 private:
  struct Knot {
    double t = 0, v = 0, w = 0, travelled = 0, turned = 0;
  };
  void add(double t, double v, double w) {
    Knot k{t, v, w, 0, 0};
    if (!knots_.empty()) {
      const Knot& last = knots_.back();
      k.travelled = last.travelled + 0.5 * (last.v + v) * (t - last.t);
      k.turned = last.turned + 0.5 * (last.w + w) * (t - last.t);
    }
    knots_.push_back(k);
  }
  /// The last knot at or before t, or the first.
  size_t before(double t) const {
    const auto after =
        std::upper_bound(knots_.begin(), knots_.end(), t, [](double x, const Knot& k) { return x < k.t; });
    return after == knots_.begin() ? 0 : static_cast<size_t>(after - knots_.begin()) - 1;
  }
  double interpolated(double t, double Knot::*field) const {
    const size_t i = before(t);
    const Knot& a = knots_[i];
    if (t <= a.t || i + 1 == knots_.size()) return a.*field;
    const Knot& b = knots_[i + 1];
    return a.*field + (b.*field - a.*field) * (t - a.t) / (b.t - a.t);
  }
  double integral(double t, double Knot::*rate, double Knot::*sum) const {
    const Knot& a = knots_[before(t)];
    return a.*sum + 0.5 * (a.*rate + interpolated(t, rate)) * (t - a.t);
  }
  std::vector<Knot> knots_;
  Knot origin_;
};

std::unique_ptr<Motion> makeMotion(const TrajectoryParams& p) {
  if (p.kind == "table") return std::make_unique<Profile>(p.profile);
  if (p.kind == "circle") return std::make_unique<Sinusoid>(p.v, 2 * p.v / p.diameter_m, 0, 1, 0);
  return std::make_unique<Sinusoid>(p.v, p.w_mean, p.w_amplitude, p.w_frequency, p.w_phase);
}

/// Adds the displacement over [a, b], within which v and w are smooth.
void addDisplacement(const Motion& motion, double yaw, double a, double b, mrpt::math::TPose2D& pose) {
  static constexpr std::array<double, 5> kNode = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                                  0.9061798459386640};
  static constexpr std::array<double, 5> kWeight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                                    0.4786286704993665, 0.2369268850561891};
  const double half = 0.5 * (b - a);
  for (size_t i = 0; i < kNode.size(); ++i) {
    const double t = 0.5 * (a + b) + half * kNode[i], heading = yaw + motion.turned(t);
    pose.x += half * kWeight[i] * motion.v(t) * std::cos(heading);
    pose.y += half * kWeight[i] * motion.v(t) * std::sin(heading);
  }
}

}  // namespace

void TrajectoryParams::visit(ParamVisitor& p) {
  p.choice("kind", kind, {"sinusoid", "circle", "table"}, "the motion");
  p.number("duration_s", duration_s, {1e-3, 1e5}, "s", "how long the robot moves");
  p.number("step_s", step_s, {1e-4, 1}, "s", "time between samples");
  p.number("x_m", x_m, {-1e6, 1e6}, "m", "start");
  p.number("y_m", y_m, {-1e6, 1e6}, "m", "start");
  p.angle("yaw_deg", yaw, {-360, 360}, "start");
  p.number("v", v, {-50, 50}, "m/s", "speed (sinusoid, circle)");
  p.number("diameter_m", diameter_m, {-1e4, 1e4}, "m", "circle; negative: clockwise");
  p.number("w_mean", w_mean, {-20, 20}, "rad/s", "sinusoid: w = w_mean + w_amplitude sin(w_frequency t + w_phase)");
  p.number("w_amplitude", w_amplitude, {-20, 20}, "rad/s", "sinusoid");
  p.number("w_frequency", w_frequency, {1e-4, 100}, "rad/s", "sinusoid");
  p.angle("w_phase_deg", w_phase, {-360, 360}, "sinusoid");
  p.table("profile", {"t", "v", "w"}, profile, "table: v and w, linear between the rows");
}

void TrajectoryParams::check() const {
  if (duration_s < step_s) throw ConfigError("trajectory.duration_s: is shorter than trajectory.step_s");
  if (duration_s / step_s > 1e7) throw ConfigError("trajectory.step_s: gives over 10 million samples; make it longer");
  if (kind == "circle" && std::abs(diameter_m) < 1e-3)
    throw ConfigError("trajectory.diameter_m = " + shortestNumber(diameter_m) + " m: no circle; at least 0.001");
  if (kind != "table") return;
  if (profile.empty()) throw ConfigError("trajectory.profile: kind: table needs rows of t, v, w");
  for (size_t i = 1; i < profile.size(); ++i)
    if (!(profile[i][0] > profile[i - 1][0]))
      throw ConfigError("trajectory.profile[" + std::to_string(i) + "].t: times must grow from row to row");
}

std::vector<TruthSample> sampleTrajectory(const TrajectoryParams& params) {
  params.check();
  const auto motion = makeMotion(params);
  const auto corners = motion->corners();
  const auto steps = static_cast<size_t>(std::floor(params.duration_s / params.step_s + 1e-9));
  std::vector<TruthSample> out;
  out.reserve(steps + 1);
  mrpt::math::TPose2D pose(params.x_m, params.y_m, params.yaw);
  size_t corner = 0;
  for (size_t k = 0; k <= steps; ++k) {
    const double t = static_cast<double>(k) * params.step_s;
    const double before = k == 0 ? 0 : out.back().time_s;
    double from = before;
    for (; corner < corners.size() && corners[corner] < t; ++corner) {
      if (corners[corner] <= from) continue;
      addDisplacement(*motion, params.yaw, from, corners[corner], pose);
      from = corners[corner];
    }
    if (k > 0) addDisplacement(*motion, params.yaw, from, t, pose);
    pose.phi = mrpt::math::wrapToPi(params.yaw + motion->turned(t));
    out.push_back({t, pose, motion->v(t), motion->w(t), motion->travelled(t) - motion->travelled(before),
                   motion->turned(t) - motion->turned(before)});
  }
  return out;
}

}  // namespace sidestep
