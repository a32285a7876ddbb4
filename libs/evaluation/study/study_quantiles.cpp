// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sidestep {
namespace {

/// The largest k >= 1 with P(binomial(n, 1/2) < k) <= 0.025, else 1.
size_t medianRank(size_t n) {
  double sum = 0, log_term = -static_cast<double>(n) * std::log(2.0);
  for (size_t k = 0; k < n; ++k) {
    sum += std::exp(log_term);
    if (sum > 0.025) return std::max<size_t>(1, k);
    log_term += std::log(static_cast<double>(n - k)) - std::log(static_cast<double>(k + 1));
  }
  return 1;
}

QuantileLine lineOf(const Study& study, size_t row, size_t algorithm, size_t metric, std::vector<double> values) {
  QuantileLine line;
  line.row = row;
  line.algorithm = algorithm;
  line.scenario = study.rows()[row].name;
  line.algorithm_name = study.algorithms()[algorithm];
  line.metric = study.runner().metrics()[metric].name;
  line.n = values.size();
  line.at.fill(NAN);
  line.median_low = line.median_high = NAN;
  if (values.empty()) return line;
  std::sort(values.begin(), values.end());
  for (size_t i = 0; i < kQuantiles.size(); ++i) line.at[i] = quantile(values, kQuantiles[i]);
  const size_t k = medianRank(values.size());
  line.median_low = values[k - 1];
  line.median_high = values[values.size() - k];
  return line;
}

std::string shown(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return std::isfinite(value) ? text.data() : "&ndash;";
}

bool wanted(const Study& study, const std::string& metric) {
  return std::find(study.medians.begin(), study.medians.end(), metric) != study.medians.end();
}

}  // namespace

std::vector<QuantileLine> quantilesOfRuns(const Study& study, const std::vector<StudyRun>& runs) {
  const size_t rows = study.rows().size(), algorithms = study.algorithms().size();
  const size_t metrics = study.runner().metrics().size();
  std::vector<std::vector<double>> values(rows * algorithms * metrics);
  for (const auto& run : runs)
    for (size_t m = 0; m < metrics; ++m)
      if (std::isfinite(run.values[m]))
        values[(run.row * algorithms + run.algorithm) * metrics + m].push_back(run.values[m]);
  std::vector<QuantileLine> out;
  for (size_t row = 0; row < rows; ++row)
    for (size_t algorithm = 0; algorithm < algorithms; ++algorithm)
      for (size_t m = 0; m < metrics; ++m)
        out.push_back(lineOf(study, row, algorithm, m, values[(row * algorithms + algorithm) * metrics + m]));
  return out;
}

std::string quantilesCsv(const std::vector<QuantileLine>& lines) {
  std::string out = "scenario,algorithm,metric,n,min,q05,q25,median,q75,q95,max,median_low,median_high\n";
  for (const auto& l : lines) {
    for (const auto& text : {l.scenario, l.algorithm_name, l.metric}) out += text + ",";
    out += std::to_string(l.n);
    std::vector<double> numbers(l.at.begin(), l.at.end());
    numbers.insert(numbers.end(), {l.median_low, l.median_high});
    for (const double v : numbers) {
      out += ',';
      if (std::isfinite(v)) out += shortestNumber(v);
    }
    out += '\n';
  }
  return out;
}

std::string quantilesHtml(const Study& study, const std::vector<QuantileLine>& lines) {
  if (study.medians.empty()) return "";
  std::string out =
      "<h2>Medians and tails</h2>\n<p>A mean is moved by a few runs far out; these are not. The interval is of "
      "the median, between order statistics.</p>\n";
  for (const auto& metric : study.medians) {
    out += "<h3>" + metric +
           "</h3>\n<table><thead><tr><th>scenario</th><th>algorithm</th><th>n</th><th>median</th><th>95 % interval</th>"
           "<th>5 %</th><th>25 %</th><th>75 %</th><th>95 %</th><th>max</th></tr></thead><tbody>\n";
    for (const auto& l : lines) {
      if (l.metric != metric) continue;
      out += "<tr><td>" + l.scenario + "</td><td>" + l.algorithm_name + "</td><td>" + std::to_string(l.n) +
             "</td><td><b>" + shown(l.at[3]) + "</b></td><td>" + shown(l.median_low) + " &hellip; " +
             shown(l.median_high) + "</td>";
      for (const size_t i : {1, 2, 4, 5, 6}) out += "<td>" + shown(l.at[i]) + "</td>";
      out += "</tr>\n";
    }
    out += "</tbody></table>\n";
  }
  return out;
}

std::vector<SummaryLine> medianLines(const Study& study, const std::vector<QuantileLine>& lines) {
  std::vector<SummaryLine> out;
  for (const auto& l : lines) {
    if (!wanted(study, l.metric)) continue;
    SummaryLine s;
    s.row = l.row;
    s.algorithm = l.algorithm;
    s.scenario = l.scenario;
    s.algorithm_name = l.algorithm_name;
    s.metric = l.metric;
    s.summary = {l.n, l.at[3], NAN, l.median_low, l.median_high};
    out.push_back(s);
  }
  return out;
}

}  // namespace sidestep
