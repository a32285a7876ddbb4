// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "localization/filters/gate_reset.h"
#include "localization/filters/particle_cloud.h"
#include "localization/filters/resampling.h"
#include "localization/pose_filter.h"

namespace sidestep {

/// Parameters of the particle filter; sensors' noises, and those of odometry unless `printed`, belong to their models.
struct PfParams {
  int particles = 500;
  std::string likelihood = "gaussian";
  std::string motion_noise = "odometry";
  double sd1 = 0.04;  // m/s
  double sd2 = 1.2;   // rad/s
  double sd3 = 0.35;  // rad/s
  double gate_probability = 0.9973;
  double recovery_patience_s = 10;
  double recovery_share = 0.2;
  double heading_offset_sd = 0.785398163397448279;  // rad
  double heading_offset_walk = 0;                   // rad / sqrt(s)
  double yaw_rate_bias_sd = 0;                      // rad/s
  double yaw_rate_bias_walk = 5e-5;                 // rad/s / sqrt(s)
  double wheel_scale_sd = 0;
  double wheel_scale_walk = 0.0005;  // 1 / sqrt(s)
  ResamplingParams resampling;

  void visit(ParamVisitor& v);
};

/// The particle filter of section 3.2 (algorithms 1, 3, 4), with a Gaussian likelihood beside the printed one.
///
/// `gaussian`: a particle's weight is multiplied by exp(-nu' R^-1 nu / 2) + f with its own innovation nu. The floor
///
///   f = sqrt(|R| / |S|) exp(-g / 2),   S the innovations' covariance over the cloud, plus R
///
/// is the density of a false measurement, taken to be that of a true one at the bound g of the gate, so that an outlier
/// changes little; one that is outside the gate and that no particle explains better is refused. `printed`:
/// exp(-EN^0.4 / 2) with EN the length of the innovation (algorithm 3, line 18), blind to R.
///
/// A measurement much sharper than the cloud, which fewer than ten effective particles explain, moves all towards it
/// (stochastic ensemble Kalman update, Evensen 1994) instead of choosing among them; so does a fix or heading beyond
/// the 95 % quantile of what the cloud expects of one by itself: where the model is a little wrong, choosing again and
/// again at the cloud's edge would leave a few particles, all sure of the wrong pose. Measurements of a kind refused
/// for `recovery_patience_s` draw a share of the particles anew from the measurement; what comes next decides between
/// old and new.
///
/// The constant offset of the IMU's heading, the bias of the gyro and the scale error of the wheels are estimated
/// beside each particle (Rao-Blackwell; Schoen, Gustafsson, Nordlund 2005): given its path each is Gaussian with a
/// variance that is common to all. A particle that moves by a draw e of the noise sqrt(q + P h^2) of distance or turn,
/// h the step's derivative by the constant, learns K e, K = P h / (q + P h^2), and P becomes P q / (q + P h^2); the
/// weights then choose between particles that learnt different things. At standstill the gyro shows its bias.
///
/// A step of n particles costs O(n) and does not allocate. The numbers drawn depend on the seed and the calls alone.
class ParticleFilter : public PoseFilter {
 public:
  ParticleFilter(const PfParams& params, uint64_t seed);
  void start(const PoseBelief& belief) override;
  void predict(const MotionStep& motion) override;
  Correction correct(const Measurement& measurement) override;
  PoseBelief estimate() const override { return cloud_.belief(); }
  void save(std::vector<double>& out) const override;
  void restore(const std::vector<double>& state) override;

  const ParticleCloud& cloud() const { return cloud_; }
  /// Groups of neighbouring particles with at least 1 % of the weight each. Neighbours lie within two cells of
  /// `resampling.kld_cell_*`, or what is wider, the spread of the cloud by n^(1/7) (Silverman's rule for three
  /// dimensions).
  std::vector<PoseMode> modes() const override;

 protected:
  /// Multiplies the weights by likelihood_ + floor and lets their sum be 1.
  void multiplyWeights(double floor);
  bool degenerate() const;
  void resample();
  auto likelihoods() const { return likelihood_.head(static_cast<Eigen::Index>(cloud_.size())); }
  auto likelihoods() { return likelihood_.head(static_cast<Eigen::Index>(cloud_.size())); }
  /// The first particles stay as a draw of the cloud, the last `count` are to be set; together they weigh `share`.
  void makeRoom(size_t count, double share);

  PfParams params_;
  Random random_;
  ParticleCloud cloud_;
  Eigen::ArrayXd likelihood_;                             // scratch: what weights are multiplied with
  double offset_var_ = 0, bias_var_ = 0, scale_var_ = 0;  // given a particle's path

 private:
  void innovations(const Measurement& m);
  void positionInnovations(const Measurement& m);
  void headingInnovations(const Measurement& m, int row);
  void rangeInnovations(const Measurement& m);
  Eigen::Matrix3d noise(const Measurement& m) const;
  Eigen::Matrix3d meanSquares(int size, Eigen::Vector3d& mean) const;
  double learnScale(const MotionStep& step, double& distance_var);
  double learnBias(const MotionStep& step, double& turn_var);
  Correction correctPose(const Measurement& m);
  void weighByGaussian(int size, const Eigen::Matrix3d& R);
  void weighAsPrinted(int size);
  void moveTowards(const Measurement& m, const Eigen::Matrix3d& S, const Eigen::Matrix3d& R);
  void updateConstants(const Measurement& m);
  void inject(const Measurement& m);
  mrpt::math::TPose2D drawFrom(const Measurement& m, Eigen::Index like);
  void roughen(size_t count);
  size_t wantedSize(size_t drawn);
  auto row(int k) const { return nu_[static_cast<size_t>(k)].head(static_cast<Eigen::Index>(cloud_.size())); }
  auto row(int k) { return nu_[static_cast<size_t>(k)].head(static_cast<Eigen::Index>(cloud_.size())); }

  static constexpr double kLeastVariance = 1e-12;  // of a measurement said to be exact

  ResamplingScheme scheme_;
  std::array<double, 4> gate_{}, unexpected_{};  // NIS bounds by degrees of freedom
  Resampler resampler_;
  CellCounter cells_;
  std::vector<uint32_t> indices_;
  std::array<Eigen::ArrayXd, 3> nu_;  // innovations, a component an array
  GateReset gate_reset_;
};

std::unique_ptr<PoseFilter> makeParticleFilter(const PfParams& params, uint64_t seed);

}  // namespace sidestep
