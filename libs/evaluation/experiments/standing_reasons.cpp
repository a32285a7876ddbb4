// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/standing_reasons.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace sidestep {
namespace {

constexpr double kStanding = 0.01;  // m/s and rad/s

/// "2.31 m" and "0.70 m" become "# m".
std::string withoutNumbers(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (digit || (c == '.' && !out.empty() && out.back() == '#')) {
      if (out.empty() || out.back() != '#') out += '#';
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace

void StandingReasons::note(const PlanInput& in, const PlanOutput& out) {
  ++periods_;
  if (std::abs(in.twist.vx) >= kStanding || std::abs(in.twist.omega) >= kStanding) return;
  ++standing_;
  ++counts_[out.reason.empty() ? "no reason given" : withoutNumbers(out.reason)];
}

double StandingReasons::share() const {
  return periods_ > 0 ? static_cast<double>(standing_) / static_cast<double>(periods_) : 0;
}

std::vector<std::pair<std::string, double>> StandingReasons::reasons() const {
  std::vector<std::pair<std::string, double>> out;
  for (const auto& [reason, count] : counts_)
    out.emplace_back(reason, static_cast<double>(count) / static_cast<double>(periods_));
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return out;
}

}  // namespace sidestep
