// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/obstacle_view.h"

#include "maps/distance_field.h"

namespace sidestep {
namespace {

constexpr double kPiece_m = 0.5;  ///< longest piece of a wall that is one item

/// How much of the covariance widens the disc: along its longer axis.
double widening(const Eigen::Matrix2d& P, const MovingView& view) {
  const double mean = 0.5 * (P(0, 0) + P(1, 1)), half = 0.5 * (P(0, 0) - P(1, 1));
  const double largest = mean + std::sqrt(half * half + P(0, 1) * P(1, 0));
  return largest > 0 ? std::min(view.sigmas * std::sqrt(largest), view.widening_max_m) : 0;
}

bool finite(const MovingObstacle& o) {
  return std::isfinite(o.position.x + o.position.y + o.velocity.x + o.velocity.y + o.radius_m);
}

/// The predicted states before and after a time; the obstacle's own state stands before all of them.
struct Leg {
  PredictedState from, to;
};

Leg legAt(const MovingObstacle& o, double after_s) {
  Leg leg;
  leg.to = {0, o.position, o.covariance};
  for (const auto& state : o.predicted) {
    if (!(state.after_s > leg.to.after_s)) continue;
    leg.from = leg.to;
    leg.to = state;
    if (state.after_s >= after_s) break;
  }
  return leg;
}

}  // namespace

MovingItem predictedItem(const MovingObstacle& o, double after_s, const MovingView& view) {
  MovingItem item;
  item.middle = after_s;
  item.id = o.id;
  const Leg leg = legAt(o, after_s);
  const double span = leg.to.after_s - leg.from.after_s;
  item.vx = span > 0 ? (leg.to.position.x - leg.from.position.x) / span : o.velocity.x;
  item.vy = span > 0 ? (leg.to.position.y - leg.from.position.y) / span : o.velocity.y;
  const double past = after_s - leg.to.after_s, share = span > 0 ? std::min(1 + past / span, 1.0) : 1;
  item.x = leg.to.position.x + item.vx * past;
  item.y = leg.to.position.y + item.vy * past;
  item.widening = widening(leg.from.covariance + share * (leg.to.covariance - leg.from.covariance), view);
  item.radius = o.radius_m + item.widening;
  return item;
}

void ObstacleView::build(const Source& source, const MovingView& view, const GridBounds& bounds, double reach) {
  double widest = 0, fastest = 0;
  for (const auto& o : source.moving) {
    if (!finite(o)) continue;
    widest = std::max(widest, o.radius_m);
    fastest = std::max(fastest, std::abs(o.velocity.x) + std::abs(o.velocity.y));
  }
  const bool in_time = view.kind == MovingView::Kind::kInTime;
  const double cell = reach + (in_time ? 0 : widest) + (source.walls.empty() ? 0 : kPiece_m / 2);
  still_.start(bounds, cell, 1);
  addStill(source, view);
  still_.finish();
  field_ = source.field;
  slices_ = in_time && !source.moving.empty() ? static_cast<int>(std::ceil(view.horizon_s / kSlice_s)) : 0;
  moving_.start(bounds, reach + widest + view.widening_max_m + std::min(fastest, 4.0) * kSlice_s / 2, slices_);
  addMoving(source, view);
  moving_.finish();
}

void ObstacleView::addStill(const Source& source, const MovingView& view) {
  for (const auto& p : source.points) still_.add(0, p.x, p.y, {p.x, p.y});
  for (const auto& wall : source.walls) {
    const double dx = wall.b.x - wall.a.x, dy = wall.b.y - wall.a.y;
    const double length = std::hypot(dx, dy);
    if (!(length < 1e6)) continue;
    const int pieces = 1 + static_cast<int>(length / kPiece_m);
    for (int i = 0; i < pieces; ++i) {
      const double x = wall.a.x + dx * i / pieces, y = wall.a.y + dy * i / pieces;
      still_.add(0, x + dx / pieces / 2, y + dy / pieces / 2, {x, y, dx / pieces, dy / pieces});
    }
  }
  if (view.kind == MovingView::Kind::kInTime) return;
  for (const auto& o : source.moving) {
    if (!finite(o)) continue;
    still_.add(0, o.position.x, o.position.y, {o.position.x, o.position.y, 0, 0, o.radius_m, o.id});
    if (view.kind == MovingView::Kind::kNow) continue;
    const MovingItem then = predictedItem(o, view.one_after_s, view);
    still_.add(0, then.x, then.y, {then.x, then.y, 0, 0, o.radius_m, o.id});
  }
}

void ObstacleView::addMoving(const Source& source, const MovingView& view) {
  by_slice_.clear();
  per_slice_ = 0;
  if (slices_ == 0) return;
  for (int slice = 0; slice < slices_; ++slice)
    for (const auto& o : source.moving) {
      if (!finite(o)) continue;
      const MovingItem item = predictedItem(o, (slice + 0.5) * kSlice_s, view);
      moving_.add(slice, item.x, item.y, item);
      by_slice_.push_back(item);
    }
  per_slice_ = by_slice_.size() / static_cast<size_t>(slices_);
}

std::span<const MovingItem> ObstacleView::movingIn(double t) const {
  if (slices_ == 0 || !(t >= 0)) return {};
  const auto slice = static_cast<size_t>(std::min(t / kSlice_s, slices_ - 1.0));
  return {by_slice_.data() + slice * per_slice_, per_slice_};
}

Proximity ObstacleView::ofField(double x, double y) const {
  mrpt::math::TPoint2D gradient;
  const double distance = field_->clearance(x, y, gradient);
  return {distance, gradient.x, gradient.y};
}

}  // namespace sidestep
