// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/map_walls.h"

namespace sidestep {
namespace {

/// Lines along one axis: line k lies between rows k - 1 and k, and runs over cells 0 .. length - 1.
template <class Blocked, class Line>
void findLines(int lines, int length, const Blocked& blocked, const Line& line) {
  for (int k = 0; k <= lines; ++k) {
    int begin = -1;
    for (int i = 0; i <= length; ++i) {
      const bool edge = i < length && blocked(k - 1, i) != blocked(k, i);
      if (edge && begin < 0) begin = i;
      if (edge || begin < 0) continue;
      line(k, begin, i);
      begin = -1;
    }
  }
}

}  // namespace

std::vector<Segment> wallsOf(const GridMap& map, const ObstacleParams& obstacles) {
  const GridFrame frame = map.frame();
  const std::vector<uint8_t> cells = blockedCells(map, obstacles);
  const auto blocked = [&](int ix, int iy) {
    if (ix < 0 || iy < 0 || ix >= frame.width || iy >= frame.height) return false;
    return cells[static_cast<size_t>(iy) * static_cast<size_t>(frame.width) + static_cast<size_t>(ix)] != 0;
  };
  const auto corner = [&](int ix, int iy) {
    return frame.T_map_grid.composePoint({frame.resolution_m * ix, frame.resolution_m * iy});
  };
  std::vector<Segment> out;
  findLines(
      frame.height, frame.width, [&](int row, int i) { return blocked(i, row); },
      [&](int k, int begin, int end) {
        out.push_back({corner(begin, k), corner(end, k)});
      });
  findLines(
      frame.width, frame.height, [&](int column, int i) { return blocked(column, i); },
      [&](int k, int begin, int end) {
        out.push_back({corner(k, begin), corner(k, end)});
      });
  return out;
}

}  // namespace sidestep
