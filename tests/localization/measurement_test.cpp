// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/measurement.h"

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include <random>

#include "support/jacobian.h"

namespace sidestep {
namespace {

using Kind = Measurement::Kind;
using mrpt::math::TPose2D;

TEST(Innovation, HasTheDerivativeOfCentralDifferencesForEveryKind) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> meters(-20, 20), lever(-2, 2), angle(-M_PI, M_PI);
  for (const Kind kind : {Kind::kPosition, Kind::kHeading, Kind::kPositionHeading, Kind::kRange}) {
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d pose(meters(random), meters(random), angle(random));
      Measurement m;
      m.kind = kind;
      m.p_base_sensor << lever(random), lever(random), lever(random);
      m.p_map_beacon << meters(random), meters(random), 30;  // far above: the range has no kink nearby
      auto nu = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        return innovation(m, {x(0), x(1), x(2)}).nu.head(m.size());
      };
      // A heading that is right, so that central differences do not step over the wrap.
      m.z << meters(random), meters(random), pose.z();
      if (kind == Kind::kHeading) m.z(0) = pose.z();
      const Eigen::MatrixXd expected = -support::centralDifferences(nu, pose);  // nu = z - h
      const Eigen::MatrixXd H = innovation(m, {pose(0), pose(1), pose(2)}).H.topRows(m.size());
      EXPECT_LT((H - expected).cwiseAbs().maxCoeff(), 1e-8) << H << "\n\n" << expected;
    }
  }
}

TEST(Innovation, IsZeroWhereTheSensorIsWithItsLeverArm) {
  Measurement m;
  m.p_base_sensor << 2, 1, 0;
  m.z << 10 - 1, 5 + 2, 0;  // heading 90 deg turns (2, 1) into (-1, 2)
  EXPECT_LT(innovation(m, {10, 5, M_PI / 2}).nu.norm(), 1e-12);
}

TEST(Innovation, OfARangeCountsTheHeight) {
  Measurement m;
  m.kind = Kind::kRange;
  m.p_base_sensor << 0, 0, 1;
  m.p_map_beacon << 3, 4, 13;  // 5 m on the ground, 12 m up: 13 m
  m.z(0) = 13.5;
  EXPECT_NEAR(innovation(m, {0, 0, 1}).nu(0), 0.5, 1e-12);
}

TEST(Innovation, OfARangeIsFiniteAtTheBeaconItself) {
  Measurement m;
  m.kind = Kind::kRange;
  const auto in = innovation(m, {0, 0, 0});
  EXPECT_TRUE(in.nu.allFinite() && in.H.allFinite());
}

TEST(Innovation, WrapsHeadingsAtHalfATurn) {
  Measurement m;
  m.kind = Kind::kHeading;
  m.z(0) = M_PI - 0.01;
  EXPECT_NEAR(innovation(m, {0, 0, -M_PI + 0.02}).nu(0), -0.03, 1e-12);
  m.z(0) = -M_PI + 0.01;
  EXPECT_NEAR(innovation(m, {0, 0, M_PI - 0.02}).nu(0), 0.03, 1e-12);
  m.kind = Kind::kPositionHeading;
  m.z << 0, 0, 7 * M_PI;  // an angle of several turns
  EXPECT_NEAR(innovation(m, {0, 0, M_PI - 0.1}).nu(2), 0.1, 1e-12);
}

}  // namespace
}  // namespace sidestep
