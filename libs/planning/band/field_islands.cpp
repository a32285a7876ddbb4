// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/band/field_islands.h"

#include <algorithm>
#include <cmath>

namespace sidestep {

void FieldIslands::find(const DistanceField* field, const GoalFrame& frame, double side, double radius_m) {
  points_.clear();
  if (field == nullptr || !(radius_m > 0)) return;
  constexpr double kSamplesMost = 200;  // in a row
  const double step = std::max({radius_m * 2 / 3, frame.length / kSamplesMost, 2 * side / kSamplesMost});
  columns_ = 2 + static_cast<int>(frame.length / step);
  rows_ = 2 + static_cast<int>(2 * side / step);
  const auto place = [&](int i) { return frame.point((i % columns_) * step, (i / columns_) * step - side); };
  near_.resize(static_cast<size_t>(columns_ * rows_));
  for (int i = 0; i < columns_ * rows_; ++i) {
    const auto p = place(i);
    near_[static_cast<size_t>(i)] = field->clearance(p.x, p.y) < 0.75 * step ? 1 : 0;
  }
  for (int i = 0; i < columns_ * rows_; ++i) {
    if (near_[static_cast<size_t>(i)] == 0) continue;
    points_.push_back(place(i));
    flood(i);
  }
}

void FieldIslands::flood(int from) {
  open_.assign(1, from);
  near_[static_cast<size_t>(from)] = 0;
  const auto visit = [this](int i, bool inside) {
    if (!inside || near_[static_cast<size_t>(i)] == 0) return;
    near_[static_cast<size_t>(i)] = 0;
    open_.push_back(i);
  };
  while (!open_.empty()) {
    const int i = open_.back(), column = i % columns_, row = i / columns_;
    open_.pop_back();
    visit(i - 1, column > 0);
    visit(i + 1, column + 1 < columns_);
    visit(i - columns_, row > 0);
    visit(i + columns_, row + 1 < rows_);
  }
}

}  // namespace sidestep
