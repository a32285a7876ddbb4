// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/gap_graph.h"

#include <algorithm>
#include <cmath>

#include "maps/distance_field.h"

namespace sidestep {
namespace {

constexpr int kColumnsMost = 120;
constexpr double kNarrowest_m = 1e-3;  ///< a gap or overlap is more than that

}  // namespace

void ExplorationParams::visit(ParamVisitor& v) {
  v.integer("classes_max", classes_max, {1, 16}, "bands of different classes that are optimized side by side");
  v.number("column_m", column_m, {0.05, 1}, "m", "width of the columns of the exploration graph");
  v.number("detour_share", detour_share, {0.1, 3}, "-", "reach of the graph beside the straight line, of its length");
  v.number("detour_least_m", detour_least_m, {0.5, 50}, "m", "least reach of the graph beside the straight line");
  v.number("narrow_weight", narrow_weight, {0, 1000}, "1/m^3", "cost of gaps too narrow for the wished clearance");
  v.integer("states_max", states_max, {0, 100000}, "kept of each half second of the search in space and time");
}

const std::vector<GapPath>& GapGraph::search(const Query& query) {
  layColumns(query);
  blockStill(query);
  if (!query.still_only) blockMoving(query);
  blockField(query);
  sortBlocked();
  cutGaps();
  growWays(query);
  const int last = first_gap_[static_cast<size_t>(columns_) - 1];
  found_ = 0;
  if (static_cast<int>(gaps_.size()) > last) found_ = static_cast<size_t>(ways_of_.back());
  if (paths_.size() < found_) paths_.resize(found_);
  const int goal = static_cast<int>(gaps_.size()) - 1;
  for (size_t k = 0; k < found_; ++k) trace(query, goal, static_cast<int>(k), paths_[k]);
  return paths_;
}

void GapGraph::layColumns(const Query& query) {
  const double length = query.frame.length;
  columns_ = std::clamp(static_cast<int>(std::ceil(length / params_.column_m)), 2, kColumnsMost);
  width_ = std::max(length / columns_, 1e-3);
  side_ = std::max(params_.detour_least_m, params_.detour_share * length);
  blocked_.clear();
}

void GapGraph::blockDisc(const Query& query, double u, double v, double radius, int first, int last) {
  if (u + radius < first * width_ || u - radius > (last + 1) * width_) return;
  // start and goal themselves are never blocked: the robot stands there, or is told to
  const double ahead = u - query.frame.length;
  const double from_start = std::sqrt(u * u + v * v), from_goal = std::sqrt(ahead * ahead + v * v);
  const double r = std::min({radius, 0.98 * from_start, 0.98 * from_goal});
  first = std::max(first, static_cast<int>(std::floor((u - r) / width_)));
  last = std::min(last, static_cast<int>(std::floor((u + r) / width_)));
  for (int c = first; c <= last; ++c) {
    const double off = std::max(std::abs(columnAt(c) - u) - width_ / 2, 0.0);
    if (off >= r) continue;
    const double half = std::sqrt(r * r - off * off);
    blocked_.push_back({c, v - half, v + half});
  }
}

void GapGraph::blockStill(const Query& query) {
  for (const auto& o : query.obstacles->still()) {
    const double length = std::abs(o.ex) + std::abs(o.ey), radius = o.radius + query.keep_out;
    const int pieces = length > 0 ? 1 + static_cast<int>(length / (0.5 * query.keep_out)) : 0;
    for (int i = 0; i <= pieces; ++i) {
      const double share = pieces > 0 ? static_cast<double>(i) / pieces : 0;
      const double x = o.x + share * o.ex, y = o.y + share * o.ey;
      blockDisc(query, query.frame.u(x, y), query.frame.v(x, y), radius, 0, columns_ - 1);
    }
  }
}

void GapGraph::blockMoving(const Query& query) {
  if (!query.obstacles->movesInTime()) return;
  const double horizon = query.obstacles->slices() * ObstacleView::kSlice_s;
  double t = 0, way = 0;
  for (int c = 0; c < columns_; ++c) {
    for (constexpr double kStep = 0.05; way < columnAt(c) && t < horizon; t += kStep)
      way = std::max(query.profile.wayAt(t + kStep), way);
    if (t >= horizon) return;
    for (const auto& o : query.obstacles->movingIn(t)) {
      const double x = o.x + o.vx * (t - o.middle), y = o.y + o.vy * (t - o.middle);
      blockDisc(query, query.frame.u(x, y), query.frame.v(x, y), o.radius + query.keep_out, c, c);
    }
  }
}

void GapGraph::blockField(const Query& query) {
  if (query.obstacles->field() == nullptr) return;
  for (int c = 0; c < columns_; ++c)
    for (double v = -side_; v < side_; v += width_) {
      const auto p = query.frame.point(columnAt(c), v);
      if (query.obstacles->field()->clearance(p.x, p.y) < query.keep_out)
        blocked_.push_back({c, v - width_ / 2, v + width_ / 2});
    }
}

void GapGraph::sortBlocked() {
  count_.assign(static_cast<size_t>(columns_) + 1, 0);
  for (const auto& b : blocked_) ++count_[static_cast<size_t>(b.column) + 1];
  for (size_t i = 1; i < count_.size(); ++i) count_[i] += count_[i - 1];
  sorted_.resize(blocked_.size());
  for (const auto& b : blocked_) sorted_[static_cast<size_t>(count_[static_cast<size_t>(b.column)]++)] = b;
  for (size_t i = count_.size() - 1; i > 0; --i) count_[i] = count_[i - 1];
  count_[0] = 0;
  for (size_t c = 0; c + 1 < count_.size(); ++c)
    std::sort(sorted_.begin() + count_[c], sorted_.begin() + count_[c + 1],
              [](const Blocked& a, const Blocked& b) { return a.low < b.low; });
}

void GapGraph::cutGaps() {
  gaps_.clear();
  first_gap_.clear();
  for (size_t c = 0; c < static_cast<size_t>(columns_); ++c) {
    first_gap_.push_back(static_cast<int>(gaps_.size()));
    double low = -side_;
    for (int i = count_[c]; i < count_[c + 1]; ++i) {
      const auto& b = sorted_[static_cast<size_t>(i)];
      if (b.low > low + kNarrowest_m) gaps_.push_back({low, std::min(b.low, side_)});
      low = std::max(low, b.high);
      if (low >= side_) break;
    }
    if (low < side_ - kNarrowest_m) gaps_.push_back({low, side_});
  }
  first_gap_.push_back(static_cast<int>(gaps_.size()));
}

GapGraph::Gap GapGraph::portal(const Gap& a, const Gap& b, double margin) const {
  const double low = std::max(a.low, b.low), high = std::min(a.high, b.high);
  const double inset = std::min(margin, (high - low) / 2);
  return {low > -side_ ? low + inset : low, high < side_ ? high - inset : high};
}

void GapGraph::offer(int gap, const Way& way) {
  const int most = params_.classes_max;
  int& n = ways_of_[static_cast<size_t>(gap)];
  Way* all = &ways_[static_cast<size_t>(gap) * static_cast<size_t>(most)];
  int at = n;
  while (at > 0 && way.cost < all[at - 1].cost) --at;
  if (at >= most) return;
  n = std::min(n + 1, most);
  for (int k = n - 1; k > at; --k) all[k] = all[k - 1];
  all[at] = way;
}

void GapGraph::growWays(const Query& query) {
  const int most = params_.classes_max, goal = static_cast<int>(gaps_.size());
  const double margin = query.wished - query.keep_out;
  gaps_.push_back({0, 0});  // the goal
  ways_of_.assign(gaps_.size(), 0);
  ways_.resize(gaps_.size() * static_cast<size_t>(most));
  for (int g = first_gap_[0]; g < first_gap_[1]; ++g)
    if (gaps_[static_cast<size_t>(g)].low <= 0 && gaps_[static_cast<size_t>(g)].high >= 0) offer(g, {0, 0, -1, -1});
  const auto extend = [&](int from, int to, double v_low, double v_high, double run, double narrow) {
    for (int k = 0; k < ways_of_[static_cast<size_t>(from)]; ++k) {
      const Way& way = ways_[static_cast<size_t>(from * most + k)];
      const double v = std::clamp(way.v, v_low, v_high);
      offer(to, {way.cost + std::hypot(run, v - way.v) + narrow, v, from, k});
    }
  };
  for (int c = 0; c + 1 < columns_; ++c) {
    const int begin = first_gap_[static_cast<size_t>(c)], end = first_gap_[static_cast<size_t>(c) + 1];
    const int stop = first_gap_[static_cast<size_t>(c) + 2];
    for (int g = begin, next = end; g < end; ++g) {
      const Gap& a = gaps_[static_cast<size_t>(g)];
      if (ways_of_[static_cast<size_t>(g)] == 0) continue;
      while (next < stop && gaps_[static_cast<size_t>(next)].high <= a.low) ++next;
      for (int h = next; h < stop && gaps_[static_cast<size_t>(h)].low < a.high; ++h) {
        const Gap& b = gaps_[static_cast<size_t>(h)];
        const double overlap = std::min(a.high, b.high) - std::max(a.low, b.low);
        if (overlap < kNarrowest_m) continue;
        const Gap p = portal(a, b, margin);
        const double missing = std::max(margin - overlap / 2, 0.0);
        extend(g, h, p.low, p.high, width_, params_.narrow_weight * missing * missing * width_);
      }
    }
  }
  for (int g = first_gap_[static_cast<size_t>(columns_) - 1]; g < goal; ++g)
    if (gaps_[static_cast<size_t>(g)].low <= 0 && gaps_[static_cast<size_t>(g)].high >= 0)
      extend(g, goal, 0, 0, width_, 0);
}

/// Shortest string through the portals, start and goal held: relaxation with over-shoot.
void GapGraph::pullTaut(size_t n) {
  constexpr int kSweeps = 60;
  constexpr double kOver = 1.8;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (size_t i = 0; i < n; ++i) {
      const double before = i > 0 ? string_[i - 1] : 0, after = i + 1 < n ? string_[i + 1] : 0;
      const double to = string_[i] + kOver * ((before + after) / 2 - string_[i]);
      string_[i] = std::clamp(to, portals_[i].low, portals_[i].high);
    }
}

void GapGraph::trace(const Query& query, int gap, int way, GapPath& out) {
  const double margin = query.wished - query.keep_out;
  const auto at = [&](int g, int k) -> const Way& { return ways_[static_cast<size_t>(g * params_.classes_max + k)]; };
  out.cost = at(gap, way).cost;
  portals_.clear();
  string_.clear();
  Way step = at(gap, way);
  for (int g = step.gap; g >= 0;) {
    const Way here = at(g, step.way);
    if (here.gap >= 0) {
      portals_.push_back(portal(gaps_[static_cast<size_t>(here.gap)], gaps_[static_cast<size_t>(g)], margin));
      string_.push_back(here.v);
    }
    step = here;
    g = here.gap;
  }
  std::reverse(portals_.begin(), portals_.end());
  std::reverse(string_.begin(), string_.end());
  const size_t n = string_.size();
  pullTaut(n);
  out.points.clear();
  out.points.push_back(query.frame.point(0, 0));
  for (size_t i = 0; i < n; ++i)
    out.points.push_back(query.frame.point(static_cast<double>(i + 1) * width_, string_[i]));
  out.points.push_back(query.frame.point(query.frame.length, 0));
  out.beside = out.points.back();
  for (size_t i = 0; i < n; ++i) {
    const bool bends = (string_[i] <= portals_[i].low && portals_[i].low > -side_) ||
                       (string_[i] >= portals_[i].high && portals_[i].high < side_);
    if (!bends) continue;
    out.beside = out.points[i + 1];
    break;
  }
}

}  // namespace sidestep
