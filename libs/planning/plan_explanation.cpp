// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "planning/plan_explanation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/params.h"

namespace sidestep {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A text as one cell.
std::string inQuotes(const std::string& text) {
  std::string out;
  if (text.empty()) return out;
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
  return out;
}

std::string cell(double value) { return std::isfinite(value) ? shortestNumber(value) : ""; }

}  // namespace

size_t PlanExplanation::term(const std::string& name) {
  const auto it = std::find(terms_.begin(), terms_.end(), name);
  if (it != terms_.end()) return static_cast<size_t>(it - terms_.begin());
  terms_.push_back(name);
  return terms_.size() - 1;
}

void PlanExplanation::note(double time_s, const PlanOutput& out) {
  for (size_t i = 0; i < out.candidates.size(); ++i) {
    const PlanCandidate& c = out.candidates[i];
    const bool chosen = c.rejected.empty();
    Row& row = rows_.emplace_back();
    row.begin = shortestNumber(time_s);
    row.begin += ',';
    row.begin += std::to_string(i);
    row.begin += chosen ? ",1" : ",0";
    const bool drawn = !c.trajectory.empty();
    for (const double value : {drawn ? c.trajectory.front().v : kNone, drawn ? c.trajectory.front().w : kNone,
                               drawn ? c.trajectory.back().pose.x : kNone, drawn ? c.trajectory.back().pose.y : kNone})
      (row.begin += ',') += cell(value);
    for (const auto& [name, share] : c.costs) {
      const size_t at = term(name);
      if (row.shares.size() <= at) row.shares.resize(at + 1, kNone);
      row.shares[at] = share;
    }
    row.total = c.total;
    row.why = chosen ? out.reason : c.rejected;
  }
}

std::string PlanExplanation::csv() const {
  std::string out = "time_s,candidate,chosen,v,w,end_x,end_y,";
  for (const auto& name : terms_) (out += name) += ',';
  out += "total,why\n";
  for (const Row& row : rows_) {
    (out += row.begin) += ',';
    for (size_t i = 0; i < terms_.size(); ++i) {
      if (i < row.shares.size()) out += cell(row.shares[i]);
      out += ',';
    }
    (out += cell(row.total)) += ',';
    (out += inQuotes(row.why)) += '\n';
  }
  return out;
}

}  // namespace sidestep
