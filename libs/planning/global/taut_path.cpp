// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/global/taut_path.h"

#include <algorithm>

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;
using Points = std::vector<TPoint2D>;

constexpr int kMostRounds = 60;

double length(const Points& path) {
  double out = 0;
  for (size_t i = 1; i < path.size(); ++i) out += (path[i] - path[i - 1]).norm();
  return out;
}

/// The string in work: what it may not touch, and its points.
class String {
 public:
  String(const DistanceField& field, double clearance_m, Points& path)
      : field_(field), clearance_m_(clearance_m), path_(path) {}

  void pull() {
    jumpAhead();
    double before = length(path_);
    for (int round = 0; round < kMostRounds; ++round) {
      cutCorners();
      dropNeedless();
      const double now = length(path_);
      if (before - now < 1e-3 * field_.frame().resolution_m) break;
      before = now;
    }
  }

 private:
  bool sees(const TPoint2D& a, const TPoint2D& b) const { return field_.visible(a, b, clearance_m_); }

  /// From each point on to one far ahead that it sees: steps double while they succeed, then are halved.
  void jumpAhead() {
    Points out = {path_.front()};
    for (size_t at = 0; at + 1 < path_.size();) {
      size_t good = at + 1, step = 1;
      while (good + step < path_.size() && sees(path_[at], path_[good + step])) good += step, step *= 2;
      for (; step > 0; step /= 2)
        if (good + step < path_.size() && sees(path_[at], path_[good + step])) good += step;
      out.push_back(path_[good]);
      at = good;
    }
    path_ = std::move(out);
  }

  void dropNeedless() {
    size_t kept = 1;
    for (size_t i = 1; i + 1 < path_.size(); ++i)
      if (!sees(path_[kept - 1], path_[i + 1])) path_[kept++] = path_[i];
    path_[kept++] = path_.back();
    path_.resize(kept);
  }

  /// Replaces each corner b between a and c by two points, as far from it as they see each other.
  void cutCorners() {
    Points out = {path_.front()};
    for (size_t i = 1; i + 1 < path_.size(); ++i) {
      const TPoint2D a = out.back(), b = path_[i], c = path_[i + 1];
      const double deep = depth(a, b, c);
      if (deep > 0) out.push_back(b + (a - b) * deep);
      out.push_back(b + (c - b) * deep);
    }
    out.push_back(path_.back());
    path_ = std::move(out);
  }

  /// The largest share of both sides of a corner, to 1/64, at which they see each other.
  double depth(const TPoint2D& a, const TPoint2D& b, const TPoint2D& c) const {
    double low = 0;
    for (double step = 0.5; step > 1.0 / 128; step /= 2)
      if (const double t = low + step; sees(b + (a - b) * t, b + (c - b) * t)) low = t;
    return low;
  }

  const DistanceField& field_;
  double clearance_m_;
  Points& path_;
};

}  // namespace

void pullTaut(const DistanceField& field, double clearance_m, Points& path) {
  if (path.size() > 2) String(field, clearance_m, path).pull();
}

}  // namespace sidestep
