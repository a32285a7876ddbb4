// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace sidestep {

/// Which way a metric is better; kTarget: neither way, its meaning says where it should lie.
enum class Better { kLower, kHigher, kTarget };

/// What is known of a metric. CSV, JSON, tables, statements of studies and doc/metrics.md read it from here.
struct MetricInfo {
  std::string name;
  std::string unit;     ///< "m", "s", ...; "1" for a ratio, "yes/no" for 1 or 0, "count"
  std::string meaning;  ///< one line
  Better better = Better::kTarget;
  std::string alias;  ///< another name: column on the terminal, key in metrics.json of sidestep-simulate
};

/// A row of a table of metrics of a `Run`: one more metric is one more row.
template <class Run>
struct Metric {
  MetricInfo info;
  std::function<double(const Run&)> value;  ///< NaN where it is not defined
};

template <class Run>
using Metrics = std::vector<Metric<Run>>;

template <class Run>
std::vector<MetricInfo> infosOf(const Metrics<Run>& rows) {
  std::vector<MetricInfo> out;
  for (const auto& row : rows) out.push_back(row.info);
  return out;
}

template <class Run>
std::vector<double> valuesOf(const Metrics<Run>& rows, const Run& run) {
  std::vector<double> out;
  for (const auto& row : rows) out.push_back(row.value(run));
  return out;
}

/// Rows of a part of a run, as rows of the run.
template <class Run, class Part>
Metrics<Run> ofPart(const Metrics<Part>& rows, const Part Run::*part) {
  Metrics<Run> out;
  for (const auto& row : rows)
    out.push_back({row.info, [value = row.value, part](const Run& run) { return value(run.*part); }});
  return out;
}

inline std::vector<std::string> namesOf(const std::vector<MetricInfo>& infos) {
  std::vector<std::string> out;
  for (const auto& info : infos) out.push_back(info.name);
  return out;
}

}  // namespace sidestep
