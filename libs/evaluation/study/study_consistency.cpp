// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_consistency.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>

namespace sidestep {
namespace {

constexpr size_t kFewestRuns = 5;
const std::string kSuffix = "_in_band";

std::string verdictOf(const SampleSummary& s) {
  if (s.n < kFewestRuns) return "too few runs";
  if (s.ci_low > 1) return "over-confident";
  return s.ci_high < 1 ? "too cautious" : "consistent";
}

std::string shown(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return std::isfinite(value) ? text.data() : "&ndash;";
}

}  // namespace

std::vector<CellConsistency> consistencyOf(const std::vector<SummaryLine>& lines) {
  std::map<std::string, const SummaryLine*> in_band;  // by scenario, algorithm, metric
  const auto key = [](const SummaryLine& l, const std::string& metric) {
    return l.scenario + "\n" + l.algorithm_name + "\n" + metric;
  };
  for (const auto& l : lines)
    if (l.metric.ends_with(kSuffix)) in_band[key(l, l.metric.substr(0, l.metric.size() - kSuffix.size()))] = &l;
  std::vector<CellConsistency> out;
  for (const auto& l : lines) {
    const auto it = in_band.find(key(l, l.metric));
    if (it == in_band.end() || it->second->summary.n == 0) continue;
    const auto& s = l.summary;
    out.push_back({l.scenario, l.algorithm_name, l.metric, s.n, s.mean, s.ci_low, s.ci_high, it->second->summary.mean,
                   std::sqrt(s.mean), verdictOf(s)});
  }
  return out;
}

std::string consistencyCsv(const std::vector<CellConsistency>& cells) {
  std::string out = "scenario,algorithm,quantity,n,mean,ci_low,ci_high,share_in_band,sd_factor,verdict\n";
  for (const auto& c : cells) {
    for (const auto& text : {c.scenario, c.algorithm_name, c.quantity}) out += text + ",";
    out += std::to_string(c.n) + ",";
    for (const double v : {c.mean, c.ci_low, c.ci_high, c.share_in_band, c.sd_factor}) {
      if (std::isfinite(v)) out += shortestNumber(v);
      out += ',';
    }
    out += c.verdict + "\n";
  }
  return out;
}

std::string consistencyHtml(const std::vector<CellConsistency>& cells) {
  if (cells.empty()) return "";
  std::string out =
      "<h2>Consistency</h2>\n<p>Squared errors (nees) and squared innovations of each sensor (nis) by the covariance "
      "that "
      "the filter believed in; 1 is consistent. The verdict is by the 95 % interval of the mean over the runs; beside "
      "it the "
      "share of runs whose own 95 % band holds 1.</p>\n<table><thead><tr><th>scenario</th><th>algorithm</th><th></th>"
      "<th>mean</th><th>95 % interval</th><th>runs in band</th><th>sd, real by "
      "believed</th><th>verdict</th></tr></thead>"
      "<tbody>\n";
  for (const auto& c : cells) {
    const bool good = c.verdict == "consistent" || c.n < kFewestRuns;
    out += "<tr><td>" + c.scenario + "</td><td>" + c.algorithm_name + "</td><td>" + c.quantity + "</td><td>" +
           shown(c.mean) + "</td><td>" + shown(c.ci_low) + " &hellip; " + shown(c.ci_high) + "</td><td>" +
           shown(100 * c.share_in_band) + " %</td><td>" + shown(c.sd_factor) + "</td><td class=\"" +
           (good ? "good" : "bad") + "\">" + c.verdict + "</td></tr>\n";
  }
  return out + "</tbody></table>\n";
}

}  // namespace sidestep
