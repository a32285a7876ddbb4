// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/random.h"
#include "localization/pose_filter.h"

namespace mrpt::poses {
class CPosePDFParticles;
}

namespace sidestep {

/// Weighted samples of the pose, one array a component; arrays are as long as the capacity, the first `size()` count.
///
/// Each particle also carries what it thinks the constant offset of the IMU's heading, the bias of the gyro and the
/// scale error of the wheels are (the last two only if it learns them). Weights are >= 0 with sum 1; yaws are in [-pi,
/// pi]. Only `reserve` allocates.
class ParticleCloud {
 public:
  void reserve(size_t most);
  /// From now on `bias` and `scale` go with the particles.
  void learnMotion() { learns_motion_ = true; }
  bool learnsMotion() const { return learns_motion_; }
  size_t size() const { return size_; }
  size_t capacity() const { return static_cast<size_t>(x.size()); }
  /// New particles beyond the old size are not set.
  void resize(size_t size) { size_ = size; }

  /// Gaussian around `belief`, equal weights, offsets 0.
  void draw(const PoseBelief& belief, size_t count, Random& random);
  /// Noisy motion (3.7): arc and half turn with noise on both, then a final turn without travel (3.6). The gains say by
  /// how much a particle's scale and bias change when it went one sd farther, turned one sd more than it expected.
  struct MotionNoise {
    double distance_sd = 0, turn_sd = 0, final_turn_sd = 0;  // [m], [rad], [rad]
    double scale_gain = 0, bias_gain = 0;                    // of learnMotion: [1], [rad/s]
  };
  void move(const MotionStep& motion, const MotionNoise& noise, Random& random);
  /// The particles at `indices` (`count` of them) become the cloud, with equal weights.
  void select(const uint32_t* indices, size_t count);
  void equalWeights();
  /// Weighted mean (circular for the yaw) and covariance (of wrapped yaw differences).
  PoseBelief belief() const;
  /// Connected groups of cells of the given size, heaviest first; those under `least` are left out, and those after the
  /// first `most`.
  std::vector<PoseMode> modes(double cell_m, double cell_rad, double least, size_t most = 100) const;

  /// What lies within two cells of the heaviest cell: a mode, without looking for the others.
  PoseMode densest(double cell_m, double cell_rad) const;

  auto weights() { return weight.head(length()); }
  auto weights() const { return weight.head(length()); }

  Eigen::ArrayXd x, y, yaw, offset, weight;
  Eigen::ArrayXd bias, scale;  ///< of the gyro [rad/s], of the wheels [1]

 private:
  Eigen::Index length() const { return static_cast<Eigen::Index>(size_); }
  void learnFromNoise(const MotionStep& motion, const MotionNoise& noise);
  PoseBelief beliefOf(const Eigen::Ref<const Eigen::ArrayXd>& w) const;

  size_t size_ = 0;
  bool learns_motion_ = false;
  Eigen::ArrayXd spare_x_, spare_y_, spare_yaw_, spare_offset_;
  Eigen::ArrayXd gaussians_;  // three a particle
};

/// The border to MRPT: the same particles with logarithms of weights.
std::shared_ptr<mrpt::poses::CPosePDFParticles> toMrpt(const ParticleCloud& cloud);

}  // namespace sidestep
