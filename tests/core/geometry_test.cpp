// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry.h"

#include <gtest/gtest.h>

#include <vector>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

TEST(Geometry, TheNearestPointOfASegmentIsItsFootOrAnEnd) {
  const Segment s{{1, 1}, {3, 1}};
  EXPECT_EQ(nearestPoint(s, {2, 5}), TPoint2D(2, 1));
  EXPECT_EQ(nearestPoint(s, {-4, 0}), TPoint2D(1, 1));
  EXPECT_EQ(nearestPoint(s, {9, 0}), TPoint2D(3, 1));
  EXPECT_EQ(nearestPoint({{1, 1}, {1, 1}}, {9, 0}), TPoint2D(1, 1));
}

TEST(Geometry, TheNearestPoseIsTheFirstOfTwoEquallyNear) {
  const std::vector<mrpt::math::TPose2D> path = {{0, 2, 0}, {1, 0, 0}, {-1, 0, 0}};
  EXPECT_EQ(nearestPose(path, {0, 0}), 1u);
  EXPECT_EQ(nearestPose({}, {0, 0}), 0u);
}

TEST(Geometry, AnglesComeIntoHalfATurn) {
  EXPECT_NEAR(wrapped(M_PI), M_PI, 1e-12);
  EXPECT_NEAR(wrapped(-M_PI), M_PI, 1e-12);
  EXPECT_NEAR(wrapped(7), 7 - 2 * M_PI, 1e-12);
}

TEST(Geometry, SegmentsThatCrossOrTouchIntersect) {
  EXPECT_TRUE(intersect({{0, -1}, {0, 1}}, {{-1, 0}, {1, 0}}));
  EXPECT_TRUE(intersect({{0, 0}, {0, 1}}, {{-1, 0}, {1, 0}}));
  EXPECT_FALSE(intersect({{0, 0.1}, {0, 1}}, {{-1, 0}, {1, 0}}));
  EXPECT_FALSE(intersect({{0, 0}, {1, 0}}, {{0, 1}, {1, 1}}));
}

}  // namespace
}  // namespace sidestep
