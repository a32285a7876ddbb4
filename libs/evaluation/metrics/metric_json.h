// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <nlohmann/json.hpp>

#include "evaluation/metrics/metric.h"

namespace sidestep {

inline nlohmann::ordered_json metricJson(const MetricInfo& info, double value) {
  if (!std::isfinite(value)) return nullptr;
  if (info.unit == "yes/no") return value != 0;
  if (info.unit == "count") return static_cast<int64_t>(value);
  return value;
}

/// Adds each row under its alias, where it has one and `use_alias`, else its name. What is not defined is left out;
/// what is infinite is null.
template <class Run>
void addMetrics(const Metrics<Run>& rows, const Run& run, bool use_alias, nlohmann::ordered_json& json) {
  for (const auto& row : rows) {
    const double value = row.value(run);
    const auto& name = use_alias && !row.info.alias.empty() ? row.info.alias : row.info.name;
    if (!std::isnan(value)) json[name] = metricJson(row.info, value);
  }
}

}  // namespace sidestep
