// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "planning/local_planner.h"

namespace sidestep {

/// Collects what a planner says of itself, cycle by cycle: each candidate, the share of each term in its costs, and why
/// it lost. The planner must have been asked to `explain`.
class PlanExplanation {
 public:
  void note(double time_s, const PlanOutput& out);
  /// A row a candidate: time_s,candidate,chosen,v,w,end_x,end_y,TERMS,total,why. `end_x`, `end_y`: where its
  /// trajectory ends; `why`: why it lost, or, for the chosen one, the reason of `PlanOutput`. Terms are all that
  /// occurred.
  std::string csv() const;

 private:
  struct Row {
    std::string begin;
    std::vector<double> shares;  ///< by term, NaN where there was none
    double total = 0;
    std::string why;
  };
  size_t term(const std::string& name);

  std::vector<std::string> terms_;
  std::vector<Row> rows_;
};

}  // namespace sidestep
