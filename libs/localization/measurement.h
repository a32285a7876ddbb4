// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <cstdint>
#include <memory>

namespace sidestep {

struct Scan;

/// What a measurement says about the pose. One struct serves every filter: an EKF linearizes it, a particle filter
/// weighs it.
struct Measurement {
  enum class Kind : uint8_t {
    kPosition,         ///< x, y of the sensor: GPS (3.10)
    kHeading,          ///< yaw of the robot, apart from the sensor's constant offset: IMU (3.12)
    kPositionHeading,  ///< both (3.14)
    kRange,            ///< distance from the sensor to a known beacon, in space
    kStill,            ///< the robot stands: what the gyro says is its bias
    kScan              ///< a laser's scan, for filters that have a map
  };
  Kind kind = Kind::kPosition;
  double time_s = 0;
  int stream = 0;                                           ///< which label of the log, for the counts
  Eigen::Vector3d z = Eigen::Vector3d::Zero();              ///< the first size() count [m], [rad]
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();              ///< its noise, the first size() rows and columns
  Eigen::Vector3d p_base_sensor = Eigen::Vector3d::Zero();  ///< where the sensor sits on the robot [m]
  Eigen::Vector3d p_map_beacon = Eigen::Vector3d::Zero();   ///< for kRange [m]
  std::shared_ptr<const Scan> scan;                         ///< for kScan
  double covariance_inflation =
      1;  ///< by how much R is larger than one measurement's variance, as neighbouring errors are alike; >= 1
  bool heading_has_offset = false;  ///< a filter may estimate the constant offset of the heading

  bool tellsPosition() const { return kind == Kind::kPosition || kind == Kind::kPositionHeading; }
  bool tellsHeading() const { return kind == Kind::kHeading || kind == Kind::kPositionHeading; }
  int size() const { return kind == Kind::kPositionHeading ? 3 : kind == Kind::kPosition ? 2 : 1; }
};

/// z - h(pose) with angles wrapped, and the derivative of h by (x, y, yaw); the first size() rows count.
struct Innovation {
  Eigen::Vector3d nu = Eigen::Vector3d::Zero();
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
};

/// Innovation of (3.10)-(3.15) and of ranges, at `pose`. Not for kStill, which is about the gyro alone, nor for kScan.
Innovation innovation(const Measurement& m, const mrpt::math::TPose2D& pose);

}  // namespace sidestep
