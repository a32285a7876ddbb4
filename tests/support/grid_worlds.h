// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/random.h"
#include "maps/distance_field.h"

namespace sidestep::testing {

/// Cells and their frame.
struct GridWorld {
  GridFrame frame;
  std::vector<uint8_t> blocked;

  std::shared_ptr<const DistanceField> field(const DistanceFieldParams& params = {}) const {
    return std::make_shared<const DistanceField>(frame, blocked, params);
  }
};

/// Drawn with one character a cell, `#` blocked, the first line on top.
inline GridWorld drawn(const std::vector<std::string>& lines, double resolution_m) {
  GridWorld out{{static_cast<int>(lines[0].size()), static_cast<int>(lines.size()), resolution_m, {}}, {}};
  for (size_t row = lines.size(); row-- > 0;)
    for (const char c : lines[row]) out.blocked.push_back(c == '#' ? 1 : 0);
  return out;
}

/// Single blocked cells and blocks of them, in a frame that is moved and turned.
inline GridWorld randomWorld(Random& random) {
  GridWorld out{{static_cast<int>(20 + random.below(40)),
                 static_cast<int>(20 + random.below(40)),
                 0.1,
                 {random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3)}},
                {}};
  const int width = out.frame.width, height = out.frame.height;
  const double share = random.uniform(0, 0.12);
  for (int i = 0; i < width * height; ++i) out.blocked.push_back(random.uniform() < share ? 1 : 0);
  for (uint64_t k = random.below(6); k > 0; --k) {
    const int x0 = static_cast<int>(random.below(static_cast<uint64_t>(width))), w = static_cast<int>(random.below(15));
    const int y0 = static_cast<int>(random.below(static_cast<uint64_t>(height))),
              h = static_cast<int>(random.below(15));
    for (int y = y0; y < std::min(height, y0 + h); ++y)
      for (int x = x0; x < std::min(width, x0 + w); ++x) out.blocked[static_cast<size_t>(y * width + x)] = 1;
  }
  return out;
}

}  // namespace sidestep::testing
