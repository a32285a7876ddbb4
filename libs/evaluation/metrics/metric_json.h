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

struct MetricJsonStyle {
  bool aliases = false;            ///< the key is the row's alias, where it has one
  bool undefined_is_null = false;  ///< else what is not defined is left out
};

/// Adds each row to an object; what is infinite is null.
template <class Run>
void addMetrics(const Metrics<Run>& rows, const Run& run, const MetricJsonStyle& style, nlohmann::ordered_json& json) {
  for (const auto& row : rows) {
    const double value = row.value(run);
    if (std::isnan(value) && !style.undefined_is_null) continue;
    json[style.aliases && !row.info.alias.empty() ? row.info.alias : row.info.name] = metricJson(row.info, value);
  }
}

}  // namespace sidestep
