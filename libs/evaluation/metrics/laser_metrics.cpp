// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/laser_metrics.h"

#include <algorithm>

#include "evaluation/metrics/drive_metrics.h"

namespace sidestep {
namespace {

constexpr double kFound_m = 1;  ///< within it the robot knows where it is

}  // namespace

LaserNumbers measureTrial(const std::vector<LaserSample>& samples, double settle_s) {
  LaserNumbers out;
  DriveResult settled;
  constexpr double gaps = LaserNumbers::kGaps;
  for (const auto& s : samples) {
    if (s.pair.time_s >= settle_s) settled.pairs.push_back(s.pair);
    out.final_error_m = std::hypot(s.pair.estimate.x - s.pair.truth.x, s.pair.estimate.y - s.pair.truth.y);
    const bool is_lost = out.final_error_m > kFound_m;
    if (is_lost) out.found_after_s = NAN;
    if (!is_lost && std::isnan(out.found_after_s)) out.found_after_s = s.pair.time_s;
    const double p = s.lost_told, off = p - (is_lost ? 1 : 0);
    out.lost_share += is_lost, out.lost_told += p, out.lost_brier += off * off;
    if (p >= 0) out.lost_gaps[static_cast<size_t>(std::min(p * gaps, gaps - 1))] += off;
  }
  const double n = static_cast<double>(samples.size());
  out.settled = measureDrive(settled, {}, {}, 0).errors;
  out.lost_share /= n, out.lost_told /= n, out.lost_brier /= n;
  for (double& gap : out.lost_gaps) gap /= n;
  return out;
}

const Metrics<LaserNumbers>& laserMetrics() {
  using L = LaserNumbers;
  static const Metrics<L> rows = [] {
    Metrics<L> out = ofPart(errorMetrics(), &L::settled);
    std::erase_if(out, [](const auto& row) {  // the end is that of all samples, below
      return row.info.name == "mean_square_error_m2" || row.info.name == "final_error_m";
    });
    for (const auto& row : ofPart(neesMetrics(), &L::settled)) out.push_back(row);
    const Metrics<L> own = {
        {{"final_error_m", "m", "distance at the end", Better::kLower, ""}, [](const L& l) { return l.final_error_m; }},
        {{"found", "yes/no", "whether that is below 1 m", Better::kHigher, ""},
         [](const L& l) { return l.final_error_m < kFound_m ? 1.0 : 0.0; }},
        {{"found_after_s", "s", "when the error fell below 1 m for good", Better::kLower, ""},
         [](const L& l) { return l.found_after_s; }},
        {{"lost_share", "1", "share of the samples off by more than 1 m", Better::kLower, ""},
         [](const L& l) { return l.lost_share; }},
        {{"lost_told", "1", "mean of what the filter said of it; should be lost_share", Better::kTarget, ""},
         [](const L& l) { return l.lost_told; }},
        {{"lost_brier", "1", "mean square of said minus true (Brier score)", Better::kLower, ""},
         [](const L& l) { return l.lost_brier; }}};
    out.insert(out.end(), own.begin(), own.end());
    // the absolute values of their means over the runs add up to the expected calibration error
    for (size_t k = 0; k < L::kGaps; ++k) {
      const std::string from = std::to_string(20 * k), to = std::to_string(20 * k + 20);
      out.push_back({{"lost_gap_" + std::to_string(k + 1), "1",
                      "sum of said minus true where it said " + from + " to " + to +
                          " %, by the number of all samples; "
                          "should be 0",
                      Better::kTarget, ""},
                     [k](const L& l) { return l.lost_gaps[k]; }});
    }
    return out;
  }();
  return rows;
}

}  // namespace sidestep
