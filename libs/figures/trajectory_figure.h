// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mrpt/math/TPose2D.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sidestep {

/// A line of points that thins itself: past `limit` points every second one is dropped, so memory stays bounded and the
/// whole length stays covered. The first and the newest point are always among them.
class ThinnedLine {
 public:
  explicit ThinnedLine(size_t limit = 4000) : limit_(limit) {}
  void add(double x, double y);
  const std::vector<mrpt::math::TPoint2D>& points() const { return points_; }

 private:
  size_t limit_, stride_ = 1, seen_ = 0;
  std::vector<mrpt::math::TPoint2D> points_;
};

/// What trajectory.png shows; all in the same frame [m].
struct TrajectoryFigure {
  std::string title;
  ThinnedLine truth, odometry, estimate, fixes;  ///< fixes: GPS, drawn as dots
  struct Ellipse {
    mrpt::math::TPose2D pose;
    Eigen::Matrix2d covariance;
  };
  std::vector<Ellipse> ellipses;  ///< some 20 along the estimate, drawn at 95 %
};

/// Draws the figure with gnuplot: equal scales, axes labelled in metres, a legend outside the plot.
/// The view holds truth, estimate and odometry; odometry that runs off by more than three times the extent of the
/// others is cut, and the legend says so, as it does for fixes outside. Same figure, same bytes.
/// @throws Error (internal) with gnuplot's message if it cannot be run.
void drawTrajectory(const TrajectoryFigure& figure, const std::string& png_file);

}  // namespace sidestep
