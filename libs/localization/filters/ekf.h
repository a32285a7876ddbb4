// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <memory>

#include "core/params.h"
#include "localization/filters/gate_reset.h"
#include "localization/pose_filter.h"

namespace sidestep {

/// Parameters of the EKF; noises belong to the motion and sensor models.
struct EkfParams {
  bool gate = true;
  double gate_probability = 0.9973;
  double gate_patience_s = 30;
  double heading_offset_sd = 0.785398163397448279;  // rad
  double heading_offset_walk = 0;                   // rad / sqrt(s)
  double yaw_rate_bias_sd = 0;                      // rad/s
  double yaw_rate_bias_walk = 0;                    // rad/s / sqrt(s)
  double wheel_scale_sd = 0;
  double wheel_scale_walk = 0;  // 1 / sqrt(s)
  double turn_scale_sd = 0;
  double turn_pull_sd = 0;  // rad/m

  void visit(ParamVisitor& v);
  bool calibratesMotion() const {
    return yaw_rate_bias_sd > 0 || wheel_scale_sd > 0 || turn_scale_sd > 0 || turn_pull_sd > 0;
  }
};

/// The extended Kalman filter of section 3.1.
///
/// State (x, y, yaw), and what a robot's sensors get wrong and motion makes visible: with N = 4 the constant offset of
/// the IMU's heading [rad]; with N = 8 also the bias of the gyro [rad/s], the wheels' scale error (true way = (1 + s) *
/// odometry's), and where the wheels tell of turns, the error t of the track and the pull p of unequal wheels [rad/m]:
/// true turn = (1 + t) * odometry's turn + p * odometry's way.
/// Motion model (3.7), Jacobians (3.8)-(3.9), update (2.12)-(2.13); covariance in Joseph's form instead of (2.14),
/// which keeps it symmetric and positive whatever the rounding. Cost: O(N^2) a prediction, O(N^2) a measurement.
template <int N>
class Ekf final : public PoseFilter {
 public:
  explicit Ekf(const EkfParams& params);
  void start(const PoseBelief& belief) override;
  void predict(const MotionStep& motion) override;
  Correction correct(const Measurement& measurement) override;
  PoseBelief estimate() const override;
  void save(std::vector<double>& out) const override;
  void restore(const std::vector<double>& state) override;
  bool smoothBack(const std::vector<double>& before, const MotionStep& motion, const std::vector<double>& after,
                  std::vector<double>& smoothed) const override;
  void smoothReset(const std::vector<double>& before, double opened, std::vector<double>& smoothed) const override;

 private:
  using State = Eigen::Matrix<double, N, 1>;
  using Covariance = Eigen::Matrix<double, N, N>;
  /// The state after a motion, and its derivatives: by the state (the pose's rows; the others stay), (3.8) by distance
  /// and by turn instead of v and w.
  struct Transition {
    State x;
    Eigen::Matrix<double, 3, N> F;
    Eigen::Vector3d by_distance, by_turn;
  };
  Transition transition(const State& x, const MotionStep& motion) const;
  template <int M>
  Correction update(const Measurement& m, const Eigen::Matrix<double, M, 1>& nu, const Eigen::Matrix<double, M, N>& H);
  template <int M>
  Correction correctPose(const Measurement& m);
  Correction correctBias(const Measurement& m);
  mrpt::math::TPose2D pose() const { return {x_(0), x_(1), x_(2)}; }

  EkfParams params_;
  std::array<double, 4> gate_{};  // NIS bound by degrees of freedom
  State x_ = State::Zero();
  Covariance P_ = Covariance::Zero();
  GateReset gate_reset_;
};

/// The smallest EKF that does what the parameters ask for.
std::unique_ptr<PoseFilter> makeEkf(const EkfParams& params);

/// Upper quantile of the chi-square distribution for 1, 2 or 3 degrees of freedom (exact; MRPT's is an approximation).
double chiSquareQuantile(double probability, int dof);
/// P(chi^2 <= q) of `dof` = 1, 2, 3 degrees of freedom.
double chiSquareCdf(double q, int dof);

}  // namespace sidestep
