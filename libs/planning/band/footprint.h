// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/params.h"

namespace sidestep {

/// A robot that is longer than wide; 0: it is the disc of `RobotLimits::radius_m`.
struct FootprintParams {
  double length_m = 0, width_m = 0;
  double ahead_m = 0;  ///< of the rectangle's middle, from the middle between the wheels

  void visit(ParamVisitor& v);
};

/// The robot's outline as equal discs on its x axis, which together hold all of it: what is clear of the discs is clear
/// of the robot. A rectangle of length L and width W cut into n pieces needs radius sqrt((L / 2 n)^2 + (W / 2)^2).
struct Footprint {
  static constexpr int kDiscsMost = 8;
  double radius_m = 0.3;
  int discs = 1;
  std::array<double, kDiscsMost> along_m{};  ///< where their centres are, ahead of the base

  Footprint() = default;
  explicit Footprint(double disc_radius_m) : radius_m(disc_radius_m) {}
  Footprint(const FootprintParams& p, double disc_radius_m) : radius_m(disc_radius_m) {
    if (!(p.length_m > 0 && p.width_m > 0)) return;
    discs = std::clamp(static_cast<int>(std::lround(2 * p.length_m / p.width_m)) - 1, 1, kDiscsMost);
    const double piece = p.length_m / discs;
    radius_m = std::hypot(piece / 2, p.width_m / 2);
    for (int i = 0; i < discs; ++i) at(i) = p.ahead_m - p.length_m / 2 + (i + 0.5) * piece;
  }

  double along(int disc) const { return along_m[static_cast<size_t>(disc)]; }
  bool isDisc() const { return discs == 1 && along(0) == 0; }

 private:
  double& at(int disc) { return along_m[static_cast<size_t>(disc)]; }
};

}  // namespace sidestep
