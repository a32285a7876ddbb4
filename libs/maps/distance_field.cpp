// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "maps/distance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSquareDiagonal = 1.4142135623730951;  // [cells]

CellWindow grown(const CellWindow& w, int by, int width, int height) {
  return {std::max(0, w.ix_min - by), std::max(0, w.iy_min - by), std::min(width - 1, w.ix_max + by),
          std::min(height - 1, w.iy_max + by)};
}

bool isEmpty(const CellWindow& w) { return w.ix_min > w.ix_max || w.iy_min > w.iy_max; }

cv::Rect rectangle(const CellWindow& w) {
  return {w.ix_min, w.iy_min, w.ix_max - w.ix_min + 1, w.iy_max - w.iy_min + 1};
}

/// Exact Euclidean distance of each nonzero pixel to the nearest zero pixel, in pixels; OpenCV's numbers for an image
/// without zeros mean nothing, so then it is infinity. `out` keeps its memory if it has the size.
void distances(const cv::Mat& free, cv::Mat& out) {
  if (cv::countNonZero(free) < static_cast<int>(free.total())) {
    cv::distanceTransform(free, out, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    return;
  }
  out.create(free.size(), CV_32F);
  out.setTo(std::numeric_limits<float>::infinity());
}

cv::Mat distances(const cv::Mat& free) {
  cv::Mat out;
  distances(free, out);
  return out;
}

double distanceToSegment(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double t = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// 0 inside.
double distanceToPolygon(const TPoint2D& p, std::span<const TPoint2D> corners) {
  double nearest = kInfinity;
  bool inside = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const auto &a = corners[i], &b = corners[j];
    nearest = std::min(nearest, distanceToSegment(p, a, b));
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
  }
  return inside ? 0 : nearest;
}

}  // namespace

TPoint2D GridFrame::centre(int ix, int iy) const {
  const double x = (ix + 0.5) * resolution_m, y = (iy + 0.5) * resolution_m;
  const double c = std::cos(T_map_grid.phi), s = std::sin(T_map_grid.phi);
  return {T_map_grid.x + c * x - s * y, T_map_grid.y + s * x + c * y};
}

void DistanceFieldParams::visit(ParamVisitor& v) {
  v.number("cap_m", cap_m, {0.05, 1000}, "m", "farther obstacles count as being this far");
  v.flag("negative_inside", negative_inside, "inside of obstacles the field is minus the way out, instead of 0");
}

DistanceField::DistanceField(const GridFrame& frame, size_t cells, const DistanceFieldParams& params)
    : frame_(frame), params_(params) {
  if (frame.width <= 0 || frame.height <= 0) throw ConfigError("distance field: the map has no cells");
  if (!(frame.resolution_m > 0) || !std::isfinite(frame.resolution_m))
    throw ConfigError("distance field: the resolution must be a positive number of metres");
  if (cells != static_cast<size_t>(frame.width) * static_cast<size_t>(frame.height))
    throw ConfigError("distance field: as many cells are needed as the frame has");
  cos_ = std::cos(frame.T_map_grid.phi), sin_ = std::sin(frame.T_map_grid.phi);
  cells_per_m_ = 1 / frame.resolution_m;
  stride_ = static_cast<size_t>(frame.width) + 2;
  free_.assign(stride_ * (static_cast<size_t>(frame.height) + 2), 0);
  values_.resize(free_.size());
}

DistanceField::DistanceField(const GridFrame& frame, std::span<const uint8_t> blocked,
                             const DistanceFieldParams& params)
    : DistanceField(frame, blocked.size(), params) {
  for (int iy = 0; iy < frame.height; ++iy) {
    const uint8_t* row = blocked.data() + static_cast<size_t>(iy) * static_cast<size_t>(frame.width);
    std::transform(row, row + frame.width, free_.begin() + static_cast<std::ptrdiff_t>(index(0, iy)),
                   [](uint8_t b) { return static_cast<uint8_t>(b == 0 ? 255 : 0); });
  }
  compute({0, 0, frame.width + 1, frame.height + 1});
}

DistanceField::DistanceField(const GridFrame& frame, std::span<const float> clearances,
                             const DistanceFieldParams& params)
    : DistanceField(frame, clearances.size(), params) {
  const auto cap = static_cast<float>(params.cap_m);
  for (int iy = 0; iy < frame.height; ++iy)
    for (int ix = 0; ix < frame.width; ++ix) {
      const float value =
          clearances[static_cast<size_t>(iy) * static_cast<size_t>(frame.width) + static_cast<size_t>(ix)];
      values_[index(ix, iy)] = std::clamp(value, params.negative_inside ? -cap : 0.0F, cap);
      free_[index(ix, iy)] = value > 0 ? 255 : 0;
    }
}

/// How far in cells an obstacle can matter.
int DistanceField::reach() const {
  const int most = std::max(frame_.width, frame_.height) + 2;
  return static_cast<int>(std::min(std::ceil(params_.cap_m * cells_per_m_) + 1, static_cast<double>(most)));
}

/// Fills the values of a window of the padded raster from all that is free or blocked within the cap of it.
void DistanceField::compute(const CellWindow& padded) {
  const int width = frame_.width + 2, height = frame_.height + 2;
  const CellWindow source = grown(padded, reach(), width, height);
  const cv::Mat free(height, width, CV_8U, free_.data());
  cv::Mat values(height, width, CV_32F, values_.data());
  const cv::Rect part(padded.ix_min - source.ix_min, padded.iy_min - source.iy_min, rectangle(padded).width,
                      rectangle(padded).height);
  const bool all = part.size() == values.size();
  cv::Mat out = all ? values : cv::Mat();  // of the whole raster in place
  distances(free(rectangle(source)), out);
  out = out(part);
  const cv::Mat in = params_.negative_inside ? cv::Mat(distances(~free(rectangle(source)))(part)) : cv::Mat();
  const auto scale = static_cast<float>(frame_.resolution_m), cap = static_cast<float>(params_.cap_m);
  for (int row = 0; row < part.height; ++row) {
    const float* from = out.ptr<float>(row);
    const float* inside = in.empty() ? nullptr : in.ptr<float>(row);
    float* to = values.ptr<float>(padded.iy_min + row) + padded.ix_min;
    for (int i = 0; i < part.width; ++i) to[i] = std::min(cap, scale * from[i]);
    if (inside == nullptr) continue;
    for (int i = 0; i < part.width; ++i)
      if (inside[i] > 0) to[i] = std::max(-cap, scale * (1 - inside[i]));
  }
}

DistanceField::GridPoint DistanceField::toGrid(double x, double y) const {
  const double dx = (x - frame_.T_map_grid.x) * cells_per_m_, dy = (y - frame_.T_map_grid.y) * cells_per_m_;
  return {cos_ * dx + sin_ * dy + 0.5, cos_ * dy - sin_ * dx + 0.5};
}

bool DistanceField::isInside(double x, double y) const {
  const auto p = toGrid(x, y);
  return p.u >= 0.5 && p.v >= 0.5 && p.u <= frame_.width + 0.5 && p.v <= frame_.height + 0.5;
}

double DistanceField::clearance(double x, double y) const {
  TPoint2D unused;
  return clearance(x, y, unused);
}

double DistanceField::clearance(double x, double y, TPoint2D& gradient) const {
  gradient = {0, 0};
  const auto p = toGrid(x, y);
  if (!std::isfinite(p.u) || !std::isfinite(p.v)) return -kInfinity;
  const double u = std::clamp(p.u, 0.5, frame_.width + 0.5), v = std::clamp(p.v, 0.5, frame_.height + 0.5);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double a = u - i, b = v - j;
  const float* at = values_.data() + static_cast<size_t>(j) * stride_ + static_cast<size_t>(i);
  const double f00 = at[0], f10 = at[1], f01 = at[stride_], f11 = at[stride_ + 1];
  const double low = f00 + a * (f10 - f00), high = f01 + a * (f11 - f01);
  double value = low + b * (high - low);
  double du = cells_per_m_ * ((1 - b) * (f10 - f00) + b * (f11 - f01)), dv = cells_per_m_ * (high - low);
  if (p.u != u || p.v != v) {
    const double away = std::hypot(p.u - u, p.v - v);
    value -= away * frame_.resolution_m;
    if (p.u != u) du = -(p.u - u) / away;
    if (p.v != v) dv = -(p.v - v) / away;
  }
  gradient = {cos_ * du - sin_ * dv, sin_ * du + cos_ * dv};
  return value;
}

/// Smallest value on a piece of a line inside the square of centres whose first is number `at`. With the square's
/// coordinates (u, v) + t (du, dv), 0 <= t <= length, the bilinear value is q0 + q1 t + q2 t^2.
double DistanceField::lowestInSquare(size_t at, double u, double v, double du, double dv, double length) const {
  const double f00 = values_[at], f10 = values_[at + 1], f01 = values_[at + stride_], f11 = values_[at + stride_ + 1];
  const double fu = f10 - f00, fv = f01 - f00, fuv = f11 - f10 - f01 + f00;
  const double q0 = f00 + fu * u + fv * v + fuv * u * v;
  const double q1 = fu * du + fv * dv + fuv * (u * dv + v * du), q2 = fuv * du * dv;
  double lowest = std::min(q0, q0 + length * (q1 + length * q2));
  const double t = q2 > 0 ? -q1 / (2 * q2) : -1;
  if (t > 0 && t < length) lowest = std::min(lowest, q0 + t * (q1 + t * q2));
  return lowest;
}

/// Goes from square to square. The values at centres change by at most a cell's width a cell, so that from a point at a
/// distance e of the centre with value d, nothing within d - bound - e - (a square's diagonal) can be below the bound;
/// a cell more, as negative insides are measured from the other side.
double DistanceField::lowestAlong(const GridPoint& a, const GridPoint& b, double at_most, bool stop_below) const {
  const double length = std::hypot(b.u - a.u, b.v - a.v);
  const double du = length > 0 ? (b.u - a.u) / length : 1, dv = length > 0 ? (b.v - a.v) / length : 0;
  int i = 0, j = 0;
  const auto enter = [&](double t) {
    i = std::clamp(static_cast<int>(a.u + t * du), 0, frame_.width);
    j = std::clamp(static_cast<int>(a.v + t * dv), 0, frame_.height);
  };
  double lowest = at_most, t = 0;
  enter(t);
  while (i >= 0 && j >= 0 && i <= frame_.width && j <= frame_.height) {
    const double u = a.u + t * du, v = a.v + t * dv;
    const size_t at = static_cast<size_t>(j) * stride_ + static_cast<size_t>(i);
    const double here = values_[at], skip = (here - lowest) * cells_per_m_ - 2 * kSquareDiagonal - 1;
    if (skip > 1) {
      if ((t += skip) >= length) break;
      enter(t);
      continue;
    }
    const double leaves_u = du > 0 ? (i + 1 - a.u) / du : (du < 0 ? (i - a.u) / du : kInfinity);
    const double leaves_v = dv > 0 ? (j + 1 - a.v) / dv : (dv < 0 ? (j - a.v) / dv : kInfinity);
    const double next = std::clamp(std::min(leaves_u, leaves_v), t, length);
    const double corner =
        std::min(std::min(values_[at], values_[at + 1]), std::min(values_[at + stride_], values_[at + stride_ + 1]));
    if (corner < lowest) lowest = std::min(lowest, lowestInSquare(at, u - i, v - j, du, dv, next - t));
    if ((stop_below && lowest < at_most) || next >= length) break;
    t = next;
    if (leaves_u <= leaves_v)
      i += du > 0 ? 1 : -1;
    else
      j += dv > 0 ? 1 : -1;
  }
  return lowest;
}

double DistanceField::lowestAlong(const TPoint2D& a, const TPoint2D& b, double at_most) const {
  const double ends = std::min({at_most, clearance(a.x, a.y), clearance(b.x, b.y)});
  if (!isInside(a.x, a.y) || !isInside(b.x, b.y)) return ends;
  return lowestAlong(toGrid(a.x, a.y), toGrid(b.x, b.y), ends, false);
}

bool DistanceField::visible(const TPoint2D& a, const TPoint2D& b, double radius_m) const {
  if (!isInside(a.x, a.y) || !isInside(b.x, b.y)) return false;
  const bool turn = b.x < a.x || (b.x == a.x && b.y < a.y);  // so that both directions round alike
  const auto from = toGrid(a.x, a.y), to = toGrid(b.x, b.y);
  const double bound = radius_m - 1e-9;
  return (turn ? lowestAlong(to, from, bound, true) : lowestAlong(from, to, bound, true)) >= bound;
}

/// Whether no blocked cell of a row is too close; free stretches are jumped by their distance.
bool DistanceField::rowFits(int iy, int from, int to, std::span<const TPoint2D> footprint, const TPose2D& T_map_base,
                            double margin_m) const {
  for (int ix = from; ix <= to;) {
    const double value = values_[index(ix, iy)];
    if (value > 0) {
      ix += std::max(1, static_cast<int>(value * cells_per_m_ + 1e-3));
      continue;
    }
    const double distance = distanceToPolygon(T_map_base.inverseComposePoint(frame_.centre(ix, iy)), footprint);
    if (distance < margin_m || distance == 0) return false;
    ++ix;
  }
  return true;
}

bool DistanceField::polygonFits(std::span<const TPoint2D> footprint, const TPose2D& T_map_base, double margin_m) const {
  double u_min = kInfinity, u_max = -kInfinity, v_min = kInfinity, v_max = -kInfinity;
  for (const auto& corner : footprint) {
    const auto p = T_map_base.composePoint(corner);
    if (!isInside(p.x, p.y)) return false;
    const auto g = toGrid(p.x, p.y);
    u_min = std::min(u_min, g.u), u_max = std::max(u_max, g.u);
    v_min = std::min(v_min, g.v), v_max = std::max(v_max, g.v);
  }
  if (footprint.empty()) return false;
  const double margin = std::max(0.0, margin_m) * cells_per_m_;
  const auto low = [&](double w) { return std::max(-1, static_cast<int>(std::ceil(w - margin)) - 1); };
  const auto high = [&](double w, int n) { return std::min(n, static_cast<int>(std::floor(w + margin)) - 1); };
  const int from = low(u_min), to = high(u_max, frame_.width);
  for (int iy = low(v_min); iy <= high(v_max, frame_.height); ++iy)
    if (!rowFits(iy, from, to, footprint, T_map_base, margin_m)) return false;
  return true;
}

std::optional<TPoint2D> DistanceField::nearestFree(const TPoint2D& from, double clearance_m,
                                                   double max_distance_m) const {
  if (clearance(from.x, from.y) >= clearance_m) return from;
  const auto p = toGrid(from.x, from.y);
  if (!std::isfinite(p.u) || !std::isfinite(p.v)) return std::nullopt;
  const auto bounded = [](double w, int n) { return static_cast<int>(std::clamp(std::round(w) - 1, -1e8, n + 1e8)); };
  const int ix0 = bounded(p.u, frame_.width), iy0 = bounded(p.v, frame_.height);
  double best = max_distance_m * cells_per_m_;
  int best_ix = -1, best_iy = -1;
  const auto look = [&](int ix, int iy) {
    if (ix < 0 || iy < 0 || ix >= frame_.width || iy >= frame_.height ||
        static_cast<double>(atCell(ix, iy)) < clearance_m)
      return;
    const double d = std::hypot(ix + 1 - p.u, iy + 1 - p.v);
    const bool lower = iy < best_iy || (iy == best_iy && ix < best_ix);
    if (d < best || (d == best && (best_ix < 0 || lower))) best = d, best_ix = ix, best_iy = iy;
  };
  const int far_x = std::max(std::abs(ix0), std::abs(frame_.width - 1 - ix0));
  const int far_y = std::max(std::abs(iy0), std::abs(frame_.height - 1 - iy0));
  const int near_x = std::max({0, -ix0, ix0 - frame_.width + 1}), near_y = std::max({0, -iy0, iy0 - frame_.height + 1});
  for (int r = std::max(near_x, near_y); r <= std::max(far_x, far_y) && r - 1 <= best; ++r) {
    for (int ix = std::max(0, ix0 - r); ix <= std::min(frame_.width - 1, ix0 + r); ++ix)
      look(ix, iy0 - r), look(ix, iy0 + r);
    for (int iy = std::max(0, iy0 - r + 1); iy <= std::min(frame_.height - 1, iy0 + r - 1); ++iy)
      look(ix0 - r, iy), look(ix0 + r, iy);
  }
  if (best_ix < 0) return std::nullopt;
  return frame_.centre(best_ix, best_iy);
}

/// Lets new obstacles in a window of the padded raster push the values around it down.
void DistanceField::lower(const CellWindow& padded) {
  const int width = frame_.width + 2, height = frame_.height + 2;
  const CellWindow around = grown(padded, reach(), width, height);
  cv::Mat free(rectangle(around).size(), CV_8U, cv::Scalar(255));
  const cv::Mat all(height, width, CV_8U, free_.data());
  const cv::Rect part = rectangle(padded) - cv::Point(around.ix_min, around.iy_min);
  all(rectangle(padded)).copyTo(free(part));
  const cv::Mat near = distances(free) * frame_.resolution_m;
  cv::Mat values = cv::Mat(height, width, CV_32F, values_.data())(rectangle(around));
  cv::min(values, near, values);
}

void DistanceField::update(const CellWindow& window, std::span<const uint8_t> blocked) {
  const auto columns = static_cast<size_t>(std::max(0, window.ix_max - window.ix_min + 1));
  if (blocked.size() != columns * static_cast<size_t>(std::max(0, window.iy_max - window.iy_min + 1)))
    throw ConfigError("distance field: as many cells are needed as the window has");
  const CellWindow cut = grown(window, 0, frame_.width, frame_.height);
  if (isEmpty(cut)) return;
  bool appeared = false, went = false;
  for (int iy = cut.iy_min; iy <= cut.iy_max; ++iy)
    for (int ix = cut.ix_min; ix <= cut.ix_max; ++ix) {
      const size_t from = static_cast<size_t>(iy - window.iy_min) * columns + static_cast<size_t>(ix - window.ix_min);
      const uint8_t now = blocked[from] == 0 ? 255 : 0;
      uint8_t& before = free_[index(ix, iy)];
      appeared |= now < before;
      went |= now > before;
      before = now;
    }
  const CellWindow padded = {cut.ix_min + 1, cut.iy_min + 1, cut.ix_max + 1, cut.iy_max + 1};
  if (went || (appeared && params_.negative_inside))
    compute(grown(padded, reach(), frame_.width + 2, frame_.height + 2));
  else if (appeared)
    lower(padded);
}

}  // namespace sidestep
