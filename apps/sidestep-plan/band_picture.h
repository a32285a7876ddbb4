// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "planning/band/band_planner.h"
#include "sidestep-plan/problem_file.h"

namespace sidestep {

/// Cold plans of up to nine problems, drawn beside each other: obstacles with the robot's radius around them, all bands
/// in grey, the chosen one in red.
class BandPicture {
 public:
  bool full() const { return panels_ >= 9; }
  void add(const BandProblemCase& problem, const BandPlanner& planner, double radius_m);
  /// @throws Error if gnuplot does not run
  void write(const std::string& file) const;

 private:
  std::string data_, plots_;
  int panels_ = 0;
};

}  // namespace sidestep
