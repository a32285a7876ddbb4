// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/trajectory_figure.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

std::string pictureName(const std::string& name) {
  return testing::TempDir() + "/sidestep_" + name + std::to_string(getpid()) + ".png";
}

std::string draw(const TrajectoryFigure& figure, const std::string& name) {
  const std::string file = pictureName(name);
  drawTrajectory(figure, file);
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  if (!std::getenv("SIDESTEP_KEEP_PICTURES")) std::remove(file.c_str());
  return bytes.str();
}

uint32_t bigEndian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// A circle of 20 m, odometry that drifts, fixes around the truth with one far away.
TrajectoryFigure circle(double drift) {
  TrajectoryFigure figure;
  figure.title = "it's a_{circle} $x `date` \"quoted\"";
  for (int i = 0; i <= 600; ++i) {
    const double a = 2 * std::numbers::pi * i / 600, x = 10 * std::sin(a), y = 10 - 10 * std::cos(a);
    figure.truth.add(x, y);
    figure.estimate.add(x + 0.2 * std::sin(5 * a), y + 0.2 * std::cos(3 * a));
    figure.odometry.add(x * (1 + drift * a), y + drift * a * 10);
    if (i % 10 == 0) figure.fixes.add(x + std::sin(1.0 * i), y + std::cos(1.7 * i));
    Eigen::Matrix2d covariance;
    covariance << 0.3, 0.1, 0.1, 0.15;
    if (i % 30 == 0) figure.ellipses.push_back({{x, y, 0}, covariance});
  }
  return figure;
}

TEST(ThinnedLine, KeepsItsEndsAndItsBound) {
  for (const size_t limit : {1u, 2u, 3u, 10u, 101u}) {
    ThinnedLine line(limit);
    for (int i = 0; i < 5000; ++i) {
      line.add(i, 0);
      ASSERT_LE(line.points().size(), std::max<size_t>(limit, 2));
      ASSERT_EQ(line.points().front().x, 0);
      ASSERT_EQ(line.points().back().x, i);
    }
  }
}

TEST(ThinnedLine, CoversItsLengthEvenly) {
  // 1000 points at a limit of 100 are thinned four times: every 16th is left, and the newest.
  ThinnedLine line(100);
  for (int i = 0; i < 1000; ++i) line.add(i, 0);
  const auto& points = line.points();
  EXPECT_EQ(points.size(), 64u);  // 0, 16, ..., 992 and 999
  for (size_t i = 0; i + 1 < points.size(); ++i) EXPECT_EQ(points[i].x, 16.0 * static_cast<double>(i));
}

TEST(DrawTrajectory, WritesAPngOfItsSize) {
  const std::string png = draw(circle(0.03), "circle");
  ASSERT_GT(png.size(), 10000u);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bigEndian(png, 16), 1100u);
  EXPECT_EQ(bigEndian(png, 20), 900u);
}

TEST(DrawTrajectory, WritesTheSameBytesAgain) { EXPECT_EQ(draw(circle(0.03), "a"), draw(circle(0.03), "b")); }

TEST(DrawTrajectory, CutsOdometryThatRunsAway) { EXPECT_GT(draw(circle(2), "wild").size(), 10000u); }

TEST(DrawTrajectory, DrawsANarrowLine) {
  TrajectoryFigure figure;
  figure.title = "one kilometre";
  for (int i = 0; i <= 1000; ++i) figure.truth.add(i, 0.5 * std::sin(i * 0.02));
  for (int i = 0; i <= 1000; ++i) figure.estimate.add(i, 0.5 * std::sin(i * 0.02) + 1);
  for (int i = 0; i <= 1000; ++i) figure.odometry.add(0.99 * i, 1e-4 * i * i);
  EXPECT_GT(draw(figure, "narrow").size(), 10000u);
}

TEST(DrawTrajectory, DrawsDegenerateFigures) {
  TrajectoryFigure figure;
  EXPECT_FALSE(draw(figure, "empty").empty());
  figure.fixes.add(1, 2);
  EXPECT_FALSE(draw(figure, "fix").empty());
  figure.estimate.add(std::numeric_limits<double>::quiet_NaN(), 0);
  figure.estimate.add(4e6, 5e5);
  figure.ellipses.push_back({{4e6, 5e5, 0}, Eigen::Matrix2d::Zero()});
  EXPECT_FALSE(draw(figure, "point").empty());
}

TEST(DrawTrajectory, SaysWhyItCannot) {
  try {
    drawTrajectory(circle(0), "/nowhere/x.png");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/x.png: gnuplot failed: system error: No such file or directory");
  }
}

TEST(DrawTrajectory, SaysThatGnuplotIsNotInstalled) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  try {
    drawTrajectory(circle(0), pictureName("none"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "gnuplot not found: install gnuplot-nox");
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace sidestep
