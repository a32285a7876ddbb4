// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/trajectory_figure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include "figures/gnuplot.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kChiSquare95 = 5.991464547107979;  // 2 degrees of freedom
constexpr double kAspect = 1.32;                    // width by height of the plot inside the picture

bool isFinite(const TPoint2D& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

struct Box {
  double x_min = std::numeric_limits<double>::infinity(), x_max = -x_min, y_min = x_min, y_max = -x_min;

  void add(const TPoint2D& p) {
    if (!isFinite(p)) return;
    x_min = std::min(x_min, p.x), x_max = std::max(x_max, p.x);
    y_min = std::min(y_min, p.y), y_max = std::max(y_max, p.y);
  }
  void add(const ThinnedLine& line) {
    for (const auto& p : line.points()) add(p);
  }
  bool empty() const { return !(x_min <= x_max); }
  double side() const { return std::max({x_max - x_min, y_max - y_min, 1e-3}); }
  bool holds(const TPoint2D& p) const { return p.x >= x_min && p.x <= x_max && p.y >= y_min && p.y <= y_max; }
  void grow(double margin_x, double margin_y) {
    x_min -= margin_x, x_max += margin_x;
    y_min -= margin_y, y_max += margin_y;
  }
};

bool holdsAll(const Box& box, const ThinnedLine& line) {
  return std::all_of(line.points().begin(), line.points().end(), [&](const TPoint2D& p) { return box.holds(p); });
}

/// Widens the smaller side until the box has the shape of the picture, so that equal scales use all of it.
void fitPicture(Box& box) {
  const double width = std::max(box.x_max - box.x_min, 1.0);
  const double height = std::max(box.y_max - box.y_min, 1.0 / kAspect);
  const double new_width = std::max(width, kAspect * height), new_height = std::max(height, width / kAspect);
  box.grow((new_width - (box.x_max - box.x_min)) / 2, (new_height - (box.y_max - box.y_min)) / 2);
}

Box view(const TrajectoryFigure& figure) {
  Box core;
  core.add(figure.truth);
  core.add(figure.estimate);
  Box all = core;
  all.add(figure.odometry);
  if (all.empty()) all.add(figure.fixes);
  if (all.empty()) all.add(TPoint2D(0, 0));
  const bool wild = !core.empty() && all.side() > 3 * std::max(core.side(), 1.0);
  Box box = wild ? core : all;
  const double margin = (wild ? 0.25 : 0.05) * box.side();
  box.grow(margin, margin);
  fitPicture(box);
  return box;
}

void append(std::string& out, double value) {
  char text[40];
  out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
}

void appendPoint(std::string& out, const TPoint2D& p) {
  if (!isFinite(p)) return;
  append(out, p.x);
  out += ' ';
  append(out, p.y);
  out += '\n';
}

/// Boundary of the 95 % region: centre + sqrt(5.99) * (eigenvectors scaled by the standard deviations) * unit circle.
void appendEllipse(std::string& out, const TrajectoryFigure::Ellipse& ellipse) {
  if (!ellipse.covariance.allFinite()) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(ellipse.covariance);
  const Eigen::Vector2d radii = (kChiSquare95 * solver.eigenvalues().cwiseMax(0)).cwiseSqrt();
  constexpr int kCorners = 60;
  for (int i = 0; i <= kCorners; ++i) {
    const double a = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d d = solver.eigenvectors() * radii.cwiseProduct(Eigen::Vector2d(std::cos(a), std::sin(a)));
    appendPoint(out, {ellipse.pose.x + d.x(), ellipse.pose.y + d.y()});
  }
  out += '\n';
}

/// The script: blocks of data, then one plot command.
class Script {
 public:
  void add(const std::string& data, const std::string& style, const std::string& title) {
    if (data.empty()) return;
    const std::string block = "$d" + std::to_string(++blocks_);
    data_ += block + " << EOD\n" + data + "EOD\n";
    plots_ += (blocks_ > 1 ? ", \\\n  " : "") + block + " using 1:2 " + style + " title " + gnuplotQuoted(title);
  }
  void add(const ThinnedLine& line, const std::string& style, const std::string& title) {
    std::string data;
    for (const auto& p : line.points()) appendPoint(data, p);
    add(data, style, title);
  }
  std::string text(const std::string& head) const {
    return data_ + head + "plot " + (plots_.empty() ? "NaN notitle" : plots_) + "\nunset output\n";
  }

 private:
  int blocks_ = 0;
  std::string data_, plots_;
};

std::string range(const char* axis, double low, double high) {
  std::string out = std::string("set ") + axis + "range [";
  append(out, low);
  out += ':';
  append(out, high);
  return out + "]\n";
}

std::string settings(const TrajectoryFigure& figure, const Box& box, const std::string& png_file) {
  return "set terminal pngcairo noenhanced size 1100,900 font 'sans,12'\n"
         "set encoding utf8\nset output " +
         gnuplotQuoted(png_file) + "\n" + "set title " + gnuplotQuoted(figure.title) + " noenhanced font ',14'\n" +
         "set size ratio -1\nset clip one\nset clip two\n"
         "set border 3 lc rgb '#404040'\nset tics nomirror out\n"
         "set grid back lt 1 lc rgb '#e4e4e4' lw 1\n"
         "set format '%.10g'\nset xlabel 'x [m]' offset 0,0.4\nset ylabel 'y [m]'\n"
         "set key outside below center horizontal Left reverse noenhanced samplen 3 spacing 1.2\n" +
         range("x", box.x_min, box.x_max) + range("y", box.y_min, box.y_max);
}

const ThinnedLine& markedLine(const TrajectoryFigure& figure) {
  if (!figure.estimate.points().empty()) return figure.estimate;
  return figure.truth.points().empty() ? figure.odometry : figure.truth;
}

void addEnds(Script& script, const TrajectoryFigure& figure) {
  const auto& points = markedLine(figure).points();
  if (points.empty()) return;
  std::string start, end;
  appendPoint(start, points.front());
  appendPoint(end, points.back());
  script.add(start, "with points pt 7 ps 2.6 lc rgb '#009e73'", "start");
  script.add(end, "with points pt 5 ps 1.1 lc rgb '#d55e00'", "end");
}

/// Colours of Okabe and Ito, told apart with any colour vision. The dashed truth lies on top, so that both lines show
/// where they agree.
void addLines(Script& script, const TrajectoryFigure& figure, const Box& box) {
  const bool fixes_out = !holdsAll(box, figure.fixes), odometry_out = !holdsAll(box, figure.odometry);
  std::string ellipses;
  for (const auto& ellipse : figure.ellipses) appendEllipse(ellipses, ellipse);
  script.add(figure.fixes, "with points pt 7 ps 0.6 lc rgb '#a8a8a8'",
             fixes_out ? "GPS fixes (some outside the picture)" : "GPS fixes");
  script.add(figure.odometry, "with lines lw 1.5 lc rgb '#e69f00'",
             odometry_out ? "odometry (leaves the picture)" : "odometry");
  script.add(ellipses, "with lines lw 1.2 lc rgb '#700072b2'", "95 % ellipses");
  script.add(figure.estimate, "with lines lw 2.5 lc rgb '#0072b2'", "estimate");
  script.add(figure.truth, "with lines lw 2.5 dt (8,6) lc rgb '#000000'", "truth");
}

}  // namespace

void ThinnedLine::add(double x, double y) {
  const bool newest_is_extra = seen_ > 0 && (seen_ - 1) % stride_ != 0;
  if (newest_is_extra) points_.pop_back();
  points_.emplace_back(x, y);
  ++seen_;
  if (points_.size() <= std::max<size_t>(limit_, 2)) return;
  size_t kept = 0;
  for (size_t i = 0; i < points_.size(); i += 2) points_[kept++] = points_[i];
  if (points_.size() % 2 == 0) points_[kept++] = points_.back();
  points_.resize(kept);
  stride_ *= 2;
}

void drawTrajectory(const TrajectoryFigure& figure, const std::string& png_file) {
  const Box box = view(figure);
  Script script;
  addLines(script, figure, box);
  addEnds(script, figure);
  runGnuplot(script.text(settings(figure, box, png_file)), png_file);
}

}  // namespace sidestep
