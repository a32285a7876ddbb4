// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/ekf.h"

#include <mrpt/math/wrap2pi.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "localization/filters/ekf_smoothing.h"

namespace sidestep {
namespace {
constexpr int kOffset = 3, kBias = 4, kScale = 5, kTurnScale = 6, kPull = 7;
}  // namespace

double chiSquareCdf(double q, int dof) {
  if (dof == 2) return 1 - std::exp(-q / 2);
  const double one = std::erf(std::sqrt(q / 2));
  return dof == 1 ? one : one - std::sqrt(2 * q / M_PI) * std::exp(-q / 2);
}

double chiSquareQuantile(double probability, int dof) {
  double low = 0, high = 1;
  while (chiSquareCdf(high, dof) < probability && high < 1e4) high *= 2;
  for (int i = 0; i < 100; ++i) {
    const double mid = 0.5 * (low + high);
    (chiSquareCdf(mid, dof) < probability ? low : high) = mid;
  }
  return high;
}

const char* word(Correction::Reason reason) {
  switch (reason) {
    case Correction::Reason::kAccepted:
      return "accepted";
    case Correction::Reason::kReset:
      return "accepted_after_reset";
    case Correction::Reason::kGated:
      return "outside_gate";
    case Correction::Reason::kNotFinite:
      return "not_finite";
    case Correction::Reason::kTooLate:
      return "too_late";
    case Correction::Reason::kNotObservable:
      return "not_usable";
    case Correction::Reason::kNothingNew:
      return "nothing_new";
  }
  return "";
}

bool PoseFilter::smoothBack(const std::vector<double>&, const MotionStep&, const std::vector<double>&,
                            std::vector<double>&) const {
  return false;
}
void PoseFilter::smoothReset(const std::vector<double>&, double, std::vector<double>&) const {}

void EkfParams::visit(ParamVisitor& v) {
  v.flag("gate", gate, "refuse measurements whose innovation is outside the chi-square gate");
  v.number("gate_probability", gate_probability, {0.5, 0.999999999}, "", "share of good measurements the gate lets in");
  v.number("gate_patience_s", gate_patience_s, {0, 1e9}, "s",
           "positions (or headings) all refused for this long are believed again, the covariance opened to them");
  v.angle("heading_offset_sd_deg", heading_offset_sd, {0, 360}, "sd of the IMU's unknown heading offset; 0 = none");
  v.angle("heading_offset_walk_deg", heading_offset_walk, {0, 90}, "how much that offset drifts in a second");
  v.angle("yaw_rate_bias_sd_deg", yaw_rate_bias_sd, {0, 90}, "sd of the gyro's unknown bias (deg/s); 0 = none");
  v.angle("yaw_rate_bias_walk_deg", yaw_rate_bias_walk, {0, 90}, "how much that bias drifts in a second (deg/s)");
  v.number("wheel_scale_sd", wheel_scale_sd, {0, 1}, "", "sd of the wheels' unknown scale error; 0 = none");
  v.number("wheel_scale_walk", wheel_scale_walk, {0, 1}, "1/sqrt(s)", "how much that scale drifts in a second");
  v.number("turn_scale_sd", turn_scale_sd, {0, 1}, "",
           "sd of the unknown relative error of turns that the wheels tell (the track); 0 = none");
  v.angle("turn_pull_sd_deg", turn_pull_sd, {0, 360}, "sd of the unknown turn by unequal wheels (deg/m); 0 = none");
}

template <int N>
Ekf<N>::Ekf(const EkfParams& params) : params_(params) {
  for (int dof = 1; dof <= 3; ++dof) gate_[static_cast<size_t>(dof)] = chiSquareQuantile(params.gate_probability, dof);
}

template <int N>
void Ekf<N>::start(const PoseBelief& belief) {
  x_.setZero();
  P_.setZero();
  x_.template head<3>() << belief.mean.x, belief.mean.y, belief.mean.phi;
  P_.template topLeftCorner<3, 3>() = belief.covariance;
  if constexpr (N > 3) P_(kOffset, kOffset) = params_.heading_offset_sd * params_.heading_offset_sd;
  if constexpr (N > 4) {
    P_(kBias, kBias) = params_.yaw_rate_bias_sd * params_.yaw_rate_bias_sd;
    P_(kScale, kScale) = params_.wheel_scale_sd * params_.wheel_scale_sd;
    P_(kTurnScale, kTurnScale) = params_.turn_scale_sd * params_.turn_scale_sd;
    P_(kPull, kPull) = params_.turn_pull_sd * params_.turn_pull_sd;
  }
  gate_reset_.clear();
}

template <int N>
typename Ekf<N>::Transition Ekf<N>::transition(const State& x, const MotionStep& motion) const {
  const bool wheels_turn = !motion.turn_from_gyro;
  double ds = motion.distance_m, turn = motion.turn_rad;
  if constexpr (N > 4) {
    ds *= 1 + x(kScale);
    turn += wheels_turn ? x(kTurnScale) * motion.turn_rad + x(kPull) * motion.distance_m : -x(kBias) * motion.dt_s;
  }
  const double beta = x(2) + 0.5 * turn, c = std::cos(beta), s = std::sin(beta);
  Transition t{x, Eigen::Matrix<double, 3, N>::Identity(), {c, s, 0}, {-0.5 * ds * s, 0.5 * ds * c, 1}};
  t.x(0) += ds * c;
  t.x(1) += ds * s;
  t.x(2) = mrpt::math::wrapToPi(x(2) + turn);
  t.F(0, 2) = -ds * s;  // (3.9)
  t.F(1, 2) = ds * c;
  if constexpr (N > 4) {
    t.F.col(kScale) = motion.distance_m * t.by_distance;
    if (wheels_turn) {
      t.F.col(kTurnScale) = motion.turn_rad * t.by_turn;
      t.F.col(kPull) = motion.distance_m * t.by_turn;
    } else {
      t.F.col(kBias) = -motion.dt_s * t.by_turn;
    }
  }
  return t;
}

template <int N>
void Ekf<N>::predict(const MotionStep& motion) {
  if (motion.still || !(motion.dt_s >= 0)) return;
  const Transition t = transition(x_, motion);
  const Eigen::Matrix<double, 3, N> FP = t.F * P_;
  Covariance P = P_;
  P.template topLeftCorner<3, 3>() = FP * t.F.transpose();
  if constexpr (N > 3) {
    P.template topRightCorner<3, N - 3>() = FP.template rightCols<N - 3>();
    P.template bottomLeftCorner<N - 3, 3>() = FP.template rightCols<N - 3>().transpose();
  }
  P.template topLeftCorner<3, 3>() += motion.distance_var * t.by_distance * t.by_distance.transpose() +
                                      motion.turn_var * t.by_turn * t.by_turn.transpose();
  if constexpr (N > 3) P(kOffset, kOffset) += params_.heading_offset_walk * params_.heading_offset_walk * motion.dt_s;
  if constexpr (N > 4) {
    P(kBias, kBias) += params_.yaw_rate_bias_walk * params_.yaw_rate_bias_walk * motion.dt_s;
    P(kScale, kScale) += params_.wheel_scale_walk * params_.wheel_scale_walk * motion.dt_s;
  }
  if (!t.x.allFinite() || !P.allFinite()) return;
  x_ = t.x;
  P_ = P;
}

template <int N>
bool Ekf<N>::smoothBack(const std::vector<double>& before, const MotionStep& motion, const std::vector<double>& after,
                        std::vector<double>& smoothed) const {
  if (motion.still || !(motion.dt_s >= 0)) return true;
  const Eigen::Map<const State> x(before.data());
  const auto F = transition(x, motion).F;
  return smoothStep({F.data(), 3, N}, before, after, smoothed);
}

template <int N>
void Ekf<N>::smoothReset(const std::vector<double>& before, double opened, std::vector<double>& smoothed) const {
  sidestep::smoothReset(N, before, opened, smoothed);
}

template <int N>
Correction Ekf<N>::correct(const Measurement& m) {
  if (m.kind == Measurement::Kind::kScan) return {Correction::Reason::kNotObservable, 0, 0};
  switch (m.size()) {
    case 3:
      return correctPose<3>(m);
    case 2:
      return correctPose<2>(m);
    default:
      return m.kind == Measurement::Kind::kStill ? correctBias(m) : correctPose<1>(m);
  }
}

template <int N>
template <int M>
Correction Ekf<N>::correctPose(const Measurement& m) {
  const Innovation in = innovation(m, pose());
  Eigen::Matrix<double, M, 1> nu = in.nu.template head<M>();
  Eigen::Matrix<double, M, N> H = Eigen::Matrix<double, M, N>::Zero();
  H.template leftCols<3>() = in.H.template topRows<M>();
  if constexpr (N > 3) {
    if (m.heading_has_offset && m.kind != Measurement::Kind::kPosition && m.kind != Measurement::Kind::kRange) {
      H(M - 1, kOffset) = 1;
      nu(M - 1) = mrpt::math::wrapToPi(nu(M - 1) - x_(kOffset));
    }
  }
  return update<M>(m, nu, H);
}

template <int N>
Correction Ekf<N>::correctBias(const Measurement& m) {
  if constexpr (N > 4) {
    Eigen::Matrix<double, 1, N> H = Eigen::Matrix<double, 1, N>::Zero();
    H(kBias) = 1;
    return update<1>(m, Eigen::Matrix<double, 1, 1>(m.z(0) - x_(kBias)), H);
  } else {
    return {Correction::Reason::kNotObservable, 0, 1};
  }
}

template <int N>
template <int M>
Correction Ekf<N>::update(const Measurement& m, const Eigen::Matrix<double, M, 1>& nu,
                          const Eigen::Matrix<double, M, N>& H) {
  const Eigen::Matrix<double, M, M> R = m.R.template topLeftCorner<M, M>();
  if (!R.allFinite() || R.diagonal().minCoeff() < 0) return {Correction::Reason::kNotFinite, 0, M};
  Covariance before = P_;
  Eigen::Matrix<double, M, M> S = H * before * H.transpose() + R;
  Eigen::Matrix<double, M, M> S_inverse = S.inverse();
  Correction result{Correction::Reason::kAccepted, nu.dot(S_inverse * nu), M};
  if (!std::isfinite(result.nis) || result.nis < 0) return {Correction::Reason::kNotFinite, 0, M};
  result.nis_single = result.nis;
  if (m.covariance_inflation > 1) {
    const Eigen::Matrix<double, M, M> S_single = S - (1 - 1 / m.covariance_inflation) * R;
    result.nis_single = nu.dot(S_single.inverse() * nu);
  }
  if (params_.gate && result.nis > gate_[M]) {
    if (!gate_reset_.lostBy(m, params_.gate_patience_s)) {
      result.reason = Correction::Reason::kGated;
      return result;
    }
    // The filter is wrong about itself: open the covariance until this innovation is an ordinary one.
    result.reason = Correction::Reason::kReset;
    before *= result.nis / M;
    S = H * before * H.transpose() + R;
    S_inverse = S.inverse();
  } else {
    gate_reset_.accepted(m);
  }
  const Eigen::Matrix<double, N, M> K = before * H.transpose() * S_inverse;  // (3.3)
  const State x = x_ + K * nu;                                               // (2.13)
  // Joseph's (I - K H) P (I - K H)' + K R K', in the order that costs N^2 M.
  const Covariance left = before - K * (H * before);
  const Covariance P = left - (left * H.transpose()) * K.transpose() + K * R * K.transpose();
  if (!x.allFinite() || !P.allFinite()) return {Correction::Reason::kNotFinite, 0, M};
  x_ = x;
  x_(2) = mrpt::math::wrapToPi(x_(2));
  P_ = 0.5 * (P + P.transpose());
  return result;
}

template <int N>
PoseBelief Ekf<N>::estimate() const {
  return {pose(), P_.template topLeftCorner<3, 3>()};
}

template <int N>
void Ekf<N>::save(std::vector<double>& out) const {
  out.resize(N + N * N + GateReset::kKinds);
  double* p = out.data();
  p = std::copy(x_.data(), x_.data() + N, p);
  p = std::copy(P_.data(), P_.data() + N * N, p);
  gate_reset_.save(p);
}

template <int N>
void Ekf<N>::restore(const std::vector<double>& state) {
  const double* p = state.data();
  std::copy(p, p + N, x_.data());
  p += N;
  std::copy(p, p + N * N, P_.data());
  p += N * N;
  gate_reset_.restore(p);
}

template class Ekf<3>;
template class Ekf<4>;
template class Ekf<8>;

std::unique_ptr<PoseFilter> makeEkf(const EkfParams& params) {
  if (params.calibratesMotion()) return std::make_unique<Ekf<8>>(params);
  if (params.heading_offset_sd > 0) return std::make_unique<Ekf<4>>(params);
  return std::make_unique<Ekf<3>>(params);
}

}  // namespace sidestep
