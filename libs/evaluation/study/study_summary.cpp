// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Values of one metric by row, algorithm and run; NaN where there is none.
class Values {
 public:
  Values(const Study& study, const std::vector<StudyRun>& runs)
      : algorithms_(study.algorithms().size()), per_cell_(static_cast<size_t>(study.runs)), by_place_(study.size()) {
    for (const auto& run : runs) by_place_[(run.row * algorithms_ + run.algorithm) * per_cell_ + run.run] = &run;
  }
  double at(size_t row, size_t algorithm, size_t run, size_t metric) const {
    const StudyRun* r = by_place_[(row * algorithms_ + algorithm) * per_cell_ + run];
    return r == nullptr ? kNaN : r->values[metric];
  }

 private:
  size_t algorithms_, per_cell_;
  std::vector<const StudyRun*> by_place_;
};

std::optional<double> reference(const Study& study, const SummaryLine& line) {
  std::optional<double> found;
  for (const auto& s : study.references())
    if (s.metric == line.metric && s.matches(line.scenario, line.algorithm_name)) found = s.value;
  return found;
}

void compare(const Study& study, const Values& values, size_t metric, Random& random, SummaryLine& line) {
  if (study.baseline.empty() || line.algorithm_name == study.baseline) return;
  line.baseline = study.baseline;
  const auto& names = study.algorithms();
  const auto other = static_cast<size_t>(std::find(names.begin(), names.end(), study.baseline) - names.begin());
  std::vector<double> differences;
  double sum = 0;
  for (size_t run = 0; run < static_cast<size_t>(study.runs); ++run) {
    const double d = values.at(line.row, line.algorithm, run, metric) - values.at(line.row, other, run, metric);
    if (!std::isfinite(d)) continue;
    differences.push_back(d);
    sum += d;
  }
  if (differences.empty()) return;
  line.difference = sum / static_cast<double>(differences.size());
  line.p_value = signFlipPValue(differences, random);
}

/// Of all runs of one cell.
std::vector<double> finiteValues(const Study& study, const Values& values, size_t row, size_t algorithm,
                                 size_t metric) {
  std::vector<double> sample;
  for (size_t run = 0; run < static_cast<size_t>(study.runs); ++run) {
    const double v = values.at(row, algorithm, run, metric);
    if (std::isfinite(v)) sample.push_back(v);
  }
  return sample;
}

SummaryLine summaryOf(const Study& study, const Values& values, size_t row, size_t algorithm, size_t metric) {
  SummaryLine line;
  line.row = row;
  line.algorithm = algorithm;
  line.scenario = study.rows()[row].name;
  line.algorithm_name = study.algorithms()[algorithm];
  line.metric = study.runner().metrics()[metric].name;
  Random random(static_cast<uint64_t>(study.seed),
                textHash(line.scenario + "," + line.algorithm_name + "," + line.metric));
  line.summary = summarize(finiteValues(study, values, row, algorithm, metric), random);
  line.reference = reference(study, line);
  compare(study, values, metric, random, line);
  return line;
}

void addCell(std::string& line, const std::string& text) {
  line += ',';
  line += text;
}

std::string cell(double value) { return std::isfinite(value) ? shortestNumber(value) : ""; }
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : ""; }

/// A number for people: five significant digits.
std::string shown(double value) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), "%.5g", value);
  return std::isfinite(value) ? text.data() : "-";
}

std::string interval(const SampleSummary& s) {
  std::string out = "[";
  out += shown(s.ci_low);
  out += ", ";
  return out += shown(s.ci_high) + "]";
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text + "  ";
}

std::string leftPadded(const std::string& text, size_t width) {
  std::string out(width > text.size() ? width - text.size() : 0, ' ');
  out += text;
  return out += "  ";
}

}  // namespace

double SummaryLine::statistic(const std::string& word) const {
  if (word == "n") return static_cast<double>(summary.n);
  if (word == "mean") return summary.mean;
  if (word == "sd") return summary.sd;
  if (word == "ci_low") return summary.ci_low;
  if (word == "ci_high") return summary.ci_high;
  if (word == "reference") return reference.value_or(kNaN);
  if (word == "difference") return difference.value_or(kNaN);
  return p_value.value_or(kNaN);
}

std::vector<SummaryLine> summarizeRuns(const Study& study, const std::vector<StudyRun>& runs) {
  const Values values(study, runs);
  std::vector<SummaryLine> lines;
  for (size_t row = 0; row < study.rows().size(); ++row)
    for (size_t algorithm = 0; algorithm < study.algorithms().size(); ++algorithm)
      for (size_t metric = 0; metric < study.runner().metrics().size(); ++metric)
        lines.push_back(summaryOf(study, values, row, algorithm, metric));
  return lines;
}

std::string summaryCsv(const std::vector<SummaryLine>& lines) {
  std::string out = "scenario,algorithm,metric,n,mean,sd,ci_low,ci_high,reference,baseline,difference,p_value\n";
  for (const auto& l : lines) {
    out += l.scenario;
    for (const auto& text : {l.algorithm_name, l.metric, std::to_string(l.summary.n)}) addCell(out, text);
    for (const double v : {l.summary.mean, l.summary.sd, l.summary.ci_low, l.summary.ci_high}) addCell(out, cell(v));
    for (const auto& text : {cell(l.reference), l.baseline, cell(l.difference), cell(l.p_value)}) addCell(out, text);
    out += '\n';
  }
  return out;
}

std::vector<ExpectationResult> checkExpectations(const Study& study, const std::vector<SummaryLine>& lines) {
  std::vector<ExpectationResult> out;
  for (const auto& expected : study.expectations()) {
    ExpectationResult result{expected.text, "no such cell was run", false};
    bool first = true;
    for (const auto& line : lines) {
      if (line.metric != expected.metric || !expected.matches(line.scenario, line.algorithm_name)) continue;
      const double seen = line.statistic(expected.statistic);
      const bool met = expected.holds(seen);
      if (first || (result.met && !met)) {
        result.seen = line.scenario + " " + line.algorithm_name + " " + expected.metric + "." + expected.statistic +
                      " is " + (std::isfinite(seen) ? shown(seen) : std::string("not defined"));
        result.met = met;
      }
      first = false;
    }
    out.push_back(result);
  }
  return out;
}

std::string summaryTable(const Study& study, const std::vector<SummaryLine>& lines) {
  size_t scenario_width = 8, algorithm_width = 9;
  for (const auto& l : lines) {
    scenario_width = std::max(scenario_width, l.scenario.size());
    algorithm_width = std::max(algorithm_width, l.algorithm_name.size());
  }
  std::string out;
  for (const auto& metric : study.reportedMetrics()) {
    out += metric + "\n  ";
    out += padded("scenario", scenario_width) + padded("algorithm", algorithm_width) +
           "   n        mean    95 % interval           published  difference     p\n";
    for (const auto& l : lines) {
      if (l.metric != metric) continue;
      out += "  ";
      out += padded(l.scenario, scenario_width) + padded(l.algorithm_name, algorithm_width) +
             leftPadded(std::to_string(l.summary.n), 4) + leftPadded(shown(l.summary.mean), 10) +
             padded(interval(l.summary), 22) + leftPadded(shown(l.reference.value_or(kNaN)), 9) +
             leftPadded(shown(l.difference.value_or(kNaN)), 10) + leftPadded(shown(l.p_value.value_or(kNaN)), 6) + "\n";
    }
  }
  return out;
}

}  // namespace sidestep
