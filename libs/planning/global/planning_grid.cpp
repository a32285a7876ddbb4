// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/planning_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

std::string place(const TPose2D& p) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", p.x, p.y);
  return text;
}

std::string metres(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f m", value);
  return text;
}

GlobalPath refused(GlobalPath::Status status, const std::string& reason) {
  GlobalPath out;
  out.status = status;
  out.reason = reason;
  return out;
}

}  // namespace

PlanningGrid::PlanningGrid(std::shared_ptr<const DistanceField> field, double clearance_m)
    : field_(std::move(field)), clearance_m_(clearance_m), stride_(field_->frame().width + 2) {
  if (!(clearance_m > 0 && clearance_m <= field_->cap()))
    throw ConfigError("clearance = " + shortestNumber(clearance_m) +
                      " m, allowed above 0 and up to the distance field's cap of " + shortestNumber(field_->cap()) +
                      " m");
  steps_ = {1, stride_ + 1, stride_, stride_ - 1, -1, -stride_ - 1, -stride_, -stride_ + 1};
  const int width = field_->frame().width, height = field_->frame().height;
  cv::Mat free = cv::Mat::zeros(height + 2, stride_, CV_8U);
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix)
      free.at<uint8_t>(iy + 1, ix + 1) = static_cast<double>(field_->atCell(ix, iy)) >= clearance_m ? 1 : 0;
  moves_.assign(free.total(), 0);
  components_.resize(free.total());
  cv::Mat labels(free.size(), CV_32S, components_.data());
  cv::connectedComponents(free, labels, 4, CV_32S);  // a diagonal move needs both cells beside it, so 4 are enough
  const uint8_t* f = free.ptr<uint8_t>();
  for (int iy = 1; iy <= height; ++iy)
    for (int ix = 1; ix <= width; ++ix) {
      const uint8_t* c = f + static_cast<size_t>(iy) * static_cast<size_t>(stride_) + ix;
      if (*c == 0) continue;
      const int e = c[1], n = c[stride_], w = c[-1], s = c[-stride_];
      const int ne = e & n & c[stride_ + 1], nw = w & n & c[stride_ - 1];
      const int sw = w & s & c[-stride_ - 1], se = e & s & c[-stride_ + 1];
      moves_[static_cast<size_t>(c - f)] =
          static_cast<uint8_t>(e | ne << 1 | n << 2 | nw << 3 | w << 4 | sw << 5 | s << 6 | se << 7);
    }
}

TPoint2D PlanningGrid::centre(uint32_t cell) const {
  const int row = static_cast<int>(cell) / stride_;
  return field_->frame().centre(static_cast<int>(cell) - row * stride_ - 1, row - 1);
}

double PlanningGrid::distanceAt(uint32_t cell) const {
  const int row = static_cast<int>(cell) / stride_;
  return static_cast<double>(field_->atCell(static_cast<int>(cell) - row * stride_ - 1, row - 1));
}

PlanningGrid::Entries PlanningGrid::entries(const TPoint2D& p) const {
  Entries out;
  if (!field_->isInside(p.x, p.y)) return out;
  const auto& frame = field_->frame();
  const auto g = frame.T_map_grid.inverseComposePoint(p);
  const int i = static_cast<int>(std::floor(g.x / frame.resolution_m + 0.5));
  const int j = static_cast<int>(std::floor(g.y / frame.resolution_m + 0.5));
  for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
    const int ix = std::clamp(i + di, 0, stride_ - 1), iy = std::clamp(j + dj, 0, field_->frame().height + 1);
    const auto cell = static_cast<uint32_t>(iy * stride_ + ix);
    if (isFree(cell) && field_->visible(p, centre(cell), clearance_m_)) out.cells[out.count++] = cell;
  }
  std::stable_sort(
      out.cells.begin(), out.cells.begin() + static_cast<std::ptrdiff_t>(out.count),
      [&](uint32_t a, uint32_t b) { return (centre(a) - p).sqrNorm() < (centre(b) - p).sqrNorm() - 1e-12; });
  return out;
}

std::optional<GlobalPath> PlanningGrid::refusal(const TPose2D& start, const TPose2D& goal) const {
  using Status = GlobalPath::Status;
  for (const bool first : {true, false}) {
    const TPose2D& p = first ? start : goal;
    const std::string who = first ? "the start " : "the goal ";
    if (!field_->isInside(p.x, p.y))
      return refused(first ? Status::kStartOutside : Status::kGoalOutside, who + place(p) + " lies outside of the map");
    const double distance = field_->clearance(p.x, p.y);
    if (distance < clearance_m_ - 1e-9)
      return refused(first ? Status::kStartBlocked : Status::kGoalBlocked,
                     who + place(p) + " is " + metres(std::max(0.0, distance)) + " from an obstacle, less than " +
                         metres(clearance_m_));
  }
  return std::nullopt;
}

PlanningGrid::Ends PlanningGrid::ends(const TPose2D& start, const TPose2D& goal) const {
  using Status = GlobalPath::Status;
  Ends out;
  if (auto why = refusal(start, goal)) {
    out.refusal = std::move(*why);
    return out;
  }
  const Entries from = entries({start.x, start.y}), to = entries({goal.x, goal.y});
  for (size_t sum = 0; sum + 1 < from.count + to.count && !out.ok; ++sum)  // the nearest that are connected
    for (size_t i = 0; i <= sum && !out.ok; ++i) {
      if (i >= from.count || sum - i >= to.count) continue;
      out.start = from.cells[i], out.goal = to.cells[sum - i];
      out.ok = component(out.start) == component(out.goal);
    }
  if (out.ok) return out;
  if (from.count == 0 || to.count == 0)
    out.refusal = refused(from.count == 0 ? Status::kStartBlocked : Status::kGoalBlocked,
                          std::string(from.count == 0 ? "the start " : "the goal ") +
                              place(from.count == 0 ? start : goal) + " is so tight that no cell beside it is free");
  else
    out.refusal = refused(Status::kUnreachable, "the goal " + place(goal) + " cannot be reached from " + place(start) +
                                                    " with a clearance of " + metres(clearance_m_));
  return out;
}

namespace {

/// Without repeated points and those in the middle of straight pieces.
std::vector<TPoint2D> cornersOf(const std::vector<TPoint2D>& points) {
  std::vector<TPoint2D> kept;
  for (const auto& p : points) {
    if (!kept.empty() && (p - kept.back()).norm() < 1e-9) continue;
    while (kept.size() >= 2) {
      const auto a = kept.back() - kept[kept.size() - 2], b = p - kept.back();
      if (a.x * b.x + a.y * b.y <= 0 || std::abs(a.x * b.y - a.y * b.x) > 1e-9 * a.norm() * b.norm()) break;
      kept.pop_back();
    }
    kept.push_back(p);
  }
  return kept;
}

}  // namespace

std::vector<TPose2D> posesAlong(const std::vector<TPoint2D>& points, double goal_heading) {
  const auto kept = cornersOf(points);
  std::vector<TPose2D> out;
  for (size_t i = 0; i < kept.size(); ++i) {
    const bool last = i + 1 == kept.size();
    const double heading = last ? goal_heading : std::atan2(kept[i + 1].y - kept[i].y, kept[i + 1].x - kept[i].x);
    out.emplace_back(kept[i].x, kept[i].y, heading);
  }
  return out;
}

double pathLength(const std::vector<TPose2D>& poses) {
  double out = 0;
  for (size_t i = 1; i < poses.size(); ++i) out += std::hypot(poses[i].x - poses[i - 1].x, poses[i].y - poses[i - 1].y);
  return out;
}

}  // namespace sidestep
