// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <limits>

#include "localization/measurement.h"

namespace sidestep {

/// How long all measurements of a kind have been refused: positions (fixes, ranges, scans), headings, the gyro's bias.
/// While one sensor of a kind is believed, another that is refused is the one at fault.
class GateReset {
 public:
  static constexpr size_t kKinds = 3;

  GateReset() { clear(); }
  void clear() { since_s_.fill(kNever); }
  void accepted(const Measurement& m) { since_s_[kind(m)] = kNever; }
  /// Counts a refusal. @return whether they have gone on for `patience_s`; then the count starts anew
  bool lostBy(const Measurement& m, double patience_s) {
    double& since = since_s_[kind(m)];
    if (since == kNever) since = m.time_s;
    if (m.time_s - since < patience_s) return false;
    since = kNever;
    return true;
  }
  /// kKinds numbers; both give the place behind them.
  double* save(double* to) const { return std::copy(since_s_.begin(), since_s_.end(), to); }
  const double* restore(const double* from) {
    std::copy(from, from + kKinds, since_s_.begin());
    return from + kKinds;
  }

 private:
  static constexpr double kNever = -std::numeric_limits<double>::max();
  static size_t kind(const Measurement& m) {
    if (m.kind == Measurement::Kind::kStill) return 2;
    return m.kind == Measurement::Kind::kHeading ? 1 : 0;
  }
  std::array<double, kKinds> since_s_;  // time of the first refusal in a row
};

}  // namespace sidestep
