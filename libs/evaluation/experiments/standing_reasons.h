// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planning/local_planner.h"

namespace sidestep {

/// Why a robot stood: the reasons that its planner gave while it did not move, with their shares of the run.
class StandingReasons {
 public:
  /// Once a control period.
  void note(const PlanInput& in, const PlanOutput& out);
  /// Share of the control periods in which the robot stood.
  double share() const;
  /// Reasons and their shares of all control periods, the largest first; numbers in a reason are left out, so that one
  /// reason counts as one.
  std::vector<std::pair<std::string, double>> reasons() const;

 private:
  size_t periods_ = 0, standing_ = 0;
  std::map<std::string, size_t> counts_;
};

}  // namespace sidestep
