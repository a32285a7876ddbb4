// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace sidestep {

/// A part of the plane [m].
struct GridBounds {
  double x_min = 0, y_min = 0, x_max = 0, y_max = 0;
};

/// Things with a place, sorted into square cells, so that those near a place are found without looking at the others.
/// Several layers share one set of cells: what is where in one slice of time. Memory is kept between uses.
template <class Item>
class BucketGrid {
 public:
  /// Forgets all. Things outside the bounds are left out. `cell` is made larger where the bounds need over 96 cells.
  void start(const GridBounds& bounds, double cell, int layers) {
    bounds_ = bounds;
    const double extent = std::max(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min);
    rate_ = 1 / std::max({cell, extent / 96, 1e-3});
    columns_ = 3 + static_cast<int>((bounds.x_max - bounds.x_min) * rate_);
    rows_ = 3 + static_cast<int>((bounds.y_max - bounds.y_min) * rate_);
    layers_ = layers;
    waiting_.clear();
    sorted_.clear();
  }

  void add(int layer, double x, double y, const Item& item) {
    if (!(x >= bounds_.x_min && x <= bounds_.x_max && y >= bounds_.y_min && y <= bounds_.y_max)) return;
    waiting_.push_back({cellOf(layer, 1 + column(x), 1 + row(y)), item});
  }

  /// Sorts what was added; to be called once, before `near`.
  void finish() {
    first_.assign(static_cast<size_t>(layers_) * columns_ * rows_ + 1, 0);
    for (const auto& w : waiting_) ++first_[w.cell + 1];
    for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    sorted_.resize(waiting_.size());
    for (const auto& w : waiting_) sorted_[first_[w.cell]++] = w.item;
    for (size_t i = first_.size() - 1; i > 0; --i) first_[i] = first_[i - 1];
    first_[0] = 0;
  }

  bool empty() const { return sorted_.empty(); }
  const std::vector<Item>& items() const { return sorted_; }

  /// Calls f(item) for all things of a layer within one cell's width of (x, y), and some farther ones.
  template <class F>
  void near(int layer, double x, double y, F&& f) const {
    if (sorted_.empty() || !(std::abs(x) < 1e9 && std::abs(y) < 1e9)) return;
    const int c = 1 + column(x), r = 1 + row(y);
    const int left = std::max(c - 1, 0), right = std::min(c + 1, columns_ - 1);
    if (left > right) return;
    for (int k = std::max(r - 1, 0); k <= std::min(r + 1, rows_ - 1); ++k) {
      const uint32_t end = first_[cellOf(layer, right, k) + 1];
      for (uint32_t i = first_[cellOf(layer, left, k)]; i < end; ++i) f(sorted_[i]);
    }
  }

 private:
  struct Waiting {
    size_t cell;
    Item item;
  };

  int column(double x) const { return static_cast<int>(std::floor((x - bounds_.x_min) * rate_)); }
  int row(double y) const { return static_cast<int>(std::floor((y - bounds_.y_min) * rate_)); }
  size_t cellOf(int layer, int c, int r) const {
    return (static_cast<size_t>(layer) * rows_ + static_cast<size_t>(r)) * columns_ + static_cast<size_t>(c);
  }

  GridBounds bounds_;
  double rate_ = 1;
  int columns_ = 0, rows_ = 0, layers_ = 0;
  std::vector<Waiting> waiting_;
  std::vector<Item> sorted_;
  std::vector<uint32_t> first_;
};

}  // namespace sidestep
