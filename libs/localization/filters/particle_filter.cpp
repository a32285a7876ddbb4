// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/particle_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>

#include "localization/filters/ekf.h"
#include "localization/filters/fast_math.h"

namespace sidestep {
namespace {

using Kind = Measurement::Kind;

constexpr double kFarthest_m = 1e8;  // what is farther out is no measurement on this planet
constexpr double kMostTurn = 1e6;    // rad
constexpr double kFewest = 10;       // effective particles that must explain a measurement
constexpr double kExpected = 0.95;   // share of good measurements that choose among the particles

bool sane(const MotionStep& s) {
  return s.dt_s >= 0 && s.dt_s < 1e9 && std::abs(s.distance_m) < kFarthest_m && std::abs(s.turn_rad) < kMostTurn &&
         s.distance_var >= 0 && s.distance_var < kFarthest_m * kFarthest_m && s.turn_var >= 0 &&
         s.turn_var < kMostTurn * kMostTurn;
}

bool sane(const Measurement& m) {
  const int n = m.size();
  const auto R = m.R.topLeftCorner(n, n);
  return m.z.head(n).allFinite() && m.z.head(n).cwiseAbs().maxCoeff() < kFarthest_m && R.allFinite() &&
         R.diagonal().minCoeff() >= 0 && R.maxCoeff() < kFarthest_m * kFarthest_m && m.p_base_sensor.allFinite() &&
         m.p_map_beacon.allFinite();
}

bool sane(const PoseBelief& b) {
  return std::abs(b.mean.x) < kFarthest_m && std::abs(b.mean.y) < kFarthest_m && std::abs(b.mean.phi) < kMostTurn &&
         b.covariance.allFinite() && b.covariance.cwiseAbs().maxCoeff() < kFarthest_m * kFarthest_m;
}

}  // namespace

void PfParams::visit(ParamVisitor& v) {
  v.integer("particles", particles, {10, 1000000}, "how many (at the start, if kld)");
  v.choice("likelihood", likelihood, {"gaussian", "printed"},
           "weight of a particle: by each component's own variance, or exp(-EN^0.4 / 2) as in algorithm 3");
  v.choice("motion_noise", motion_noise, {"odometry", "printed"},
           "noise of a motion: the variances of odometry.noise, or sd1 .. sd3 in each step");
  v.number("sd1", sd1, {0, 100}, "m/s", "printed: noise of the speed");
  v.number("sd2", sd2, {0, 100}, "rad/s", "printed: noise of the turn rate");
  v.number("sd3", sd3, {0, 100}, "rad/s", "printed: noise of the final turn");
  v.number("gate_probability", gate_probability, {0.5, 0.999999999}, "",
           "share of good measurements inside the gate; one at its bound is as likely false as true (gaussian)");
  v.number("recovery_patience_s", recovery_patience_s, {0, 1e9}, "s",
           "positions (or headings) all refused for this long draw particles anew");
  v.number("recovery_share", recovery_share, {0, 0.9}, "", "share of the particles then drawn from the measurement");
  v.angle("heading_offset_sd_deg", heading_offset_sd, {0, 360}, "sd of the IMU's unknown heading offset; 0 = none");
  v.angle("heading_offset_walk_deg", heading_offset_walk, {0, 90}, "how much that offset drifts in a second");
  v.angle("yaw_rate_bias_sd_deg", yaw_rate_bias_sd, {0, 90}, "sd of the gyro's unknown bias (deg/s); 0 = none");
  v.angle("yaw_rate_bias_walk_deg", yaw_rate_bias_walk, {0, 90},
          "how much that bias drifts in a second (deg/s); with 0 "
          "particles end up believing in one value, right or wrong");
  v.number("wheel_scale_sd", wheel_scale_sd, {0, 1}, "", "sd of the wheels' unknown scale error; 0 = none");
  v.number("wheel_scale_walk", wheel_scale_walk, {0, 1}, "1/sqrt(s)",
           "how much that scale drifts in a second; 0: as above");
  v.section("resampling", "how the next particles are drawn", [this](ParamVisitor& w) { resampling.visit(w); });
}

ParticleFilter::ParticleFilter(const PfParams& params, uint64_t seed)
    : params_(params), random_(seed), scheme_(resamplingScheme(params.resampling.scheme)) {
  for (int dof = 1; dof <= 3; ++dof) {
    gate_[static_cast<size_t>(dof)] = chiSquareQuantile(params.gate_probability, dof);
    unexpected_[static_cast<size_t>(dof)] = chiSquareQuantile(kExpected, dof);
  }
  const auto& r = params.resampling;
  const auto most = static_cast<size_t>(std::max(params.particles, r.kld ? std::max(r.kld_min, r.kld_max) : 0));
  cloud_.reserve(most);
  if (params.yaw_rate_bias_sd > 0 || params.wheel_scale_sd > 0) cloud_.learnMotion();
  resampler_.reserve(most);
  if (r.kld) cells_.reserve(most);
  indices_.resize(most);
  for (auto& a : nu_) a.resize(static_cast<Eigen::Index>(most));
  likelihood_.resize(static_cast<Eigen::Index>(most));
  start({});
}

void ParticleFilter::start(const PoseBelief& belief) {
  cloud_.draw(sane(belief) ? belief : PoseBelief(), static_cast<size_t>(params_.particles), random_);
  offset_var_ = params_.heading_offset_sd * params_.heading_offset_sd;
  bias_var_ = params_.yaw_rate_bias_sd * params_.yaw_rate_bias_sd;
  scale_var_ = params_.wheel_scale_sd * params_.wheel_scale_sd;
  gate_reset_.clear();
}

// ---- prediction ----

/// A constant of variance `constant_var` enters a step times `h`: adds it to the step's variance, and lets the step
/// that is drawn tell of it. @return ParticleCloud::MotionNoise's gain
static double learn(double& constant_var, double h, double& step_var) {
  const double q = step_var;
  step_var = q + constant_var * h * h;
  if (!(step_var > 0)) return 0;
  const double gain = constant_var * h / std::sqrt(step_var);
  constant_var *= q / step_var;
  return gain;
}

/// Adds what the wheels' unknown scale makes of the distance to its variance. @return ParticleCloud::MotionNoise's gain
double ParticleFilter::learnScale(const MotionStep& step, double& distance_var) {
  if (!(params_.wheel_scale_sd > 0)) return 0;
  scale_var_ += params_.wheel_scale_walk * params_.wheel_scale_walk * step.dt_s;
  return learn(scale_var_, step.distance_m, distance_var);
}

/// The same for the bias of the gyro, if the turn is its.
double ParticleFilter::learnBias(const MotionStep& step, double& turn_var) {
  if (!(params_.yaw_rate_bias_sd > 0)) return 0;
  bias_var_ += params_.yaw_rate_bias_walk * params_.yaw_rate_bias_walk * step.dt_s;
  if (!step.turn_from_gyro) return 0;
  return learn(bias_var_, step.dt_s, turn_var);
}

void ParticleFilter::predict(const MotionStep& motion) {
  if (motion.still || !sane(motion)) return;
  const double dt = motion.dt_s;
  const bool printed = params_.motion_noise == "printed";
  double distance_var = printed ? std::pow(params_.sd1 * dt, 2) : motion.distance_var;
  double turn_var = printed ? std::pow(params_.sd2 * dt, 2) : motion.turn_var;
  ParticleCloud::MotionNoise noise;
  noise.scale_gain = learnScale(motion, distance_var);
  noise.bias_gain = learnBias(motion, turn_var);
  noise.distance_sd = std::sqrt(distance_var);
  noise.turn_sd = std::sqrt(turn_var);
  noise.final_turn_sd = printed ? params_.sd3 * dt : 0;
  cloud_.move(motion, noise, random_);
  offset_var_ += params_.heading_offset_walk * params_.heading_offset_walk * dt;
}

// ---- correction ----

Correction ParticleFilter::correct(const Measurement& m) {
  if (m.kind == Kind::kScan) return {Correction::Reason::kNotObservable, 0, 0};  // there is no map
  if (!sane(m)) return {Correction::Reason::kNotFinite, 0, m.size()};
  if (m.kind == Kind::kStill && !(params_.yaw_rate_bias_sd > 0)) return {Correction::Reason::kNotObservable, 0, 1};
  return correctPose(m);
}

Correction ParticleFilter::correctPose(const Measurement& m) {
  const int size = m.size();
  innovations(m);
  const Eigen::Matrix3d R = noise(m);
  Eigen::Vector3d nu;
  const Eigen::Matrix3d S = meanSquares(size, nu) + R;  // the identity in rows that do not count
  Correction result{Correction::Reason::kAccepted,
                    nu.head(size).dot(S.inverse().topLeftCorner(size, size) * nu.head(size)), size};
  result.nis_single = result.nis;
  if (m.covariance_inflation > 1) {
    Eigen::Matrix3d S_single = S;
    S_single.topLeftCorner(size, size) -= (1 - 1 / m.covariance_inflation) * m.R.topLeftCorner(size, size);
    result.nis_single = nu.head(size).dot(S_single.inverse().topLeftCorner(size, size) * nu.head(size));
  }
  if (params_.likelihood == "printed" && m.kind != Kind::kStill) {
    weighAsPrinted(size);
    multiplyWeights(0);
  } else {
    weighByGaussian(size, R);
    const auto w = cloud_.weights();
    const double floor =
        std::sqrt(R.determinant() / S.determinant()) * std::exp(-0.5 * gate_[static_cast<size_t>(size)]);
    const double mean = (w * likelihoods()).sum(), squares = (w * likelihoods()).square().sum();
    const bool outside = result.nis > gate_[static_cast<size_t>(size)] && mean < floor;
    if (outside && !gate_reset_.lostBy(m, params_.recovery_patience_s)) {
      result.reason = Correction::Reason::kGated;
      return result;
    }
    if (outside) {
      result.reason = Correction::Reason::kReset;
      inject(m);
      return result;
    }
    gate_reset_.accepted(m);
    const bool unexpected = result.nis_single > unexpected_[static_cast<size_t>(size)] && m.kind != Kind::kRange;
    if (unexpected || !(mean * mean > kFewest * squares)) {
      moveTowards(m, S, R);
      return result;
    }
    multiplyWeights(floor);
  }
  updateConstants(m);
  if (params_.resampling.each_step || degenerate()) resample();
  return result;
}

bool ParticleFilter::degenerate() const {
  const double n = static_cast<double>(cloud_.size());
  return effectiveSampleSize(cloud_.weight.data(), cloud_.size()) < params_.resampling.ess_share * n;
}

void ParticleFilter::updateConstants(const Measurement& m) {
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  if (m.kind == Kind::kStill) {
    const double K = bias_var_ / (bias_var_ + std::max(m.R(0, 0), kLeastVariance));
    cloud_.bias.head(n) += K * row(0);
    bias_var_ *= 1 - K;
  }
  if (!m.tellsHeading() || !m.heading_has_offset || !(offset_var_ > 0)) return;
  const int k = m.size() - 1;
  const double S = offset_var_ + std::max(m.R(k, k), kLeastVariance), K = offset_var_ / S;
  cloud_.offset.head(n) += K * row(k);
  offset_var_ *= 1 - K;
}

void ParticleFilter::moveTowards(const Measurement& m, const Eigen::Matrix3d& S, const Eigen::Matrix3d& R) {
  const int size = m.size();
  const auto n = static_cast<Eigen::Index>(cloud_.size());
  const PoseBelief b = cloud_.belief();
  const auto w = cloud_.weights();
  const std::array<Eigen::ArrayXd*, 3> constants = {&cloud_.offset, &cloud_.bias, &cloud_.scale};
  Eigen::Vector3d mean, mean_constants;
  for (int k = 0; k < 3; ++k) mean_constants(k) = (w * constants[static_cast<size_t>(k)]->head(n)).sum();
  meanSquares(size, mean);
  Eigen::Matrix<double, 6, 3> cross = Eigen::Matrix<double, 6, 3>::Zero();  // of pose, constants and the measurement
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Vector<double, 6> d;
    d << cloud_.x[i] - b.mean.x, cloud_.y[i] - b.mean.y, wrapAngle(cloud_.yaw[i] - b.mean.phi),
        cloud_.offset[i] - mean_constants(0), cloud_.bias[i] - mean_constants(1), cloud_.scale[i] - mean_constants(2);
    for (int k = 0; k < size; ++k) cross.col(k) -= w[i] * (row(k)[i] - mean(k)) * d;
  }
  const Eigen::Matrix<double, 6, 3> K = cross * S.inverse();
  const Eigen::Matrix3d root = R.llt().matrixL();
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Vector3d e, nu = Eigen::Vector3d::Zero();
    random_.gaussians(e.data(), 3);
    e = root * e;
    for (int k = 0; k < size; ++k) nu(k) = row(k)[i] + e(k);
    const Eigen::Vector<double, 6> d = K * nu;
    if (!d.allFinite()) continue;
    cloud_.x[i] += d(0);
    cloud_.y[i] += d(1);
    cloud_.yaw[i] = wrapAngle(cloud_.yaw[i] + d(2));
    for (int k = 0; k < 3; ++k) (*constants[static_cast<size_t>(k)])[i] += d(3 + k);
  }
  innovations(m);
  updateConstants(m);
}

// ---- replay ----

void ParticleFilter::save(std::vector<double>& out) const {
  const size_t n = cloud_.size();
  const size_t arrays = cloud_.learnsMotion() ? 7 : 5;
  out.resize(4 + GateReset::kKinds + 8 + arrays * n);
  double* p = out.data();
  *p++ = static_cast<double>(n);
  *p++ = offset_var_;
  *p++ = bias_var_;
  *p++ = scale_var_;
  p = gate_reset_.save(p);
  for (const uint64_t word : random_.state()) {  // in halves, each of which a double holds exactly
    *p++ = static_cast<double>(word >> 32);
    *p++ = static_cast<double>(word & 0xffffffff);
  }
  for (const auto* a : {&cloud_.x, &cloud_.y, &cloud_.yaw, &cloud_.offset, &cloud_.weight})
    p = std::copy(a->data(), a->data() + n, p);
  if (!cloud_.learnsMotion()) return;
  for (const auto* a : {&cloud_.bias, &cloud_.scale}) p = std::copy(a->data(), a->data() + n, p);
}

void ParticleFilter::restore(const std::vector<double>& state) {
  const double* p = state.data();
  const auto n = static_cast<size_t>(*p++);
  offset_var_ = *p++;
  bias_var_ = *p++;
  scale_var_ = *p++;
  p = gate_reset_.restore(p);
  std::array<uint64_t, 4> words{};
  for (auto& word : words) {
    word = static_cast<uint64_t>(p[0]) << 32 | static_cast<uint64_t>(p[1]);
    p += 2;
  }
  random_.setState(words);
  cloud_.resize(n);
  for (auto* a : {&cloud_.x, &cloud_.y, &cloud_.yaw, &cloud_.offset, &cloud_.weight}) {
    std::copy(p, p + n, a->data());
    p += n;
  }
  if (!cloud_.learnsMotion()) return;
  for (auto* a : {&cloud_.bias, &cloud_.scale}) {
    std::copy(p, p + n, a->data());
    p += n;
  }
}

std::unique_ptr<PoseFilter> makeParticleFilter(const PfParams& params, uint64_t seed) {
  return std::make_unique<ParticleFilter>(params, seed);
}

}  // namespace sidestep
