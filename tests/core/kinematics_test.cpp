// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/kinematics.h"

#include <gtest/gtest.h>

namespace sidestep {
namespace {

TEST(Kinematics, AnArcEndsWhereGeometrySays) {
  // half a circle of radius 1 from heading north: two metres to the left, heading south
  const auto p = alongArc({1, 1, M_PI / 2}, M_PI, M_PI);
  EXPECT_NEAR(p.x, -1, 1e-12);
  EXPECT_NEAR(p.y, 1, 1e-12);
  EXPECT_NEAR(std::cos(p.phi - 3 * M_PI / 2), 1, 1e-12);
  const auto line = alongArc({0, 0, 0}, 3, 1e-12);
  EXPECT_NEAR(line.x, 3, 1e-12);
  EXPECT_NEAR(line.y, 0, 1e-11);
}

TEST(Kinematics, TheArcFromTheOriginIsTheOneFromAnyPose) {
  for (const double turn : {-3.0, -1e-5, 0.0, 1e-3, 2.0}) {
    const auto relative = arcFromOrigin(1.5, turn), from = alongArc({2, -1, 0.7}, 1.5, turn);
    EXPECT_NEAR(from.x, 2 + std::cos(0.7) * relative.x - std::sin(0.7) * relative.y, 1e-12);
    EXPECT_NEAR(from.y, -1 + std::sin(0.7) * relative.x + std::cos(0.7) * relative.y, 1e-12);
    EXPECT_EQ(relative.phi, turn);
  }
}

TEST(Kinematics, TheChordMissesTheArcByASixthOfTheSquareOfHalfTheTurn) {
  // chord / arc = sin(h) / h = 1 - h^2 / 6: 0.1 rad makes 1 - 0.05^2 / 6
  const auto exact = arcFromOrigin(1, 0.1), chord = alongChord({}, 1, 0.1);
  EXPECT_NEAR(exact.x / chord.x, 1 - 0.05 * 0.05 / 6, 1e-7);
}

TEST(Kinematics, WheelsAndBodySayTheSame) {
  const WheelMotion wheels = wheelsOf({1, 0.5}, 0.4);  // (2.2): 1 -+ 0.2 * 0.5
  EXPECT_NEAR(wheels.left, 0.9, 1e-12);
  EXPECT_NEAR(wheels.right, 1.1, 1e-12);
  const BodyMotion body = bodyOf(wheels, 0.4);
  EXPECT_NEAR(body.ahead, 1, 1e-12);
  EXPECT_NEAR(body.turn, 0.5, 1e-12);
  EXPECT_NEAR(outerWheelSpeed(-1, 0.5, 0.4), 1.1, 1e-12);
}

}  // namespace
}  // namespace sidestep
