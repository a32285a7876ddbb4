// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/metrics_json.h"

#include <sys/resource.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/errors.h"
#include "evaluation/metrics/metric_json.h"

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

const char* name(Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return "none";
    case Alignment::kFirstPose:
      return "first";
    case Alignment::kLeastSquares:
      return "se2";
  }
  return "none";
}

Json toJson(const mrpt::math::TPose2D& pose) {
  return {{"x", orNull(pose.x)}, {"y", orNull(pose.y)}, {"yaw_deg", orNull(pose.phi * 180 / std::numbers::pi)}};
}

Json toJson(const std::optional<TrajectoryErrors>& errors) {
  Json json = Json::object();
  if (!errors) return json;
  addMetrics(errorMetrics(), *errors, {}, json);
  json["samples"] = errors->samples;
  json["alignment"] = name(errors->alignment);
  json["T_truth_estimate"] = toJson(errors->T_truth_estimate);
  return json;
}

void addNees(Json& json, const TrajectoryErrors& errors) {
  json["mean_nees"] = orNull(errors.mean_nees);
  if (!errors.mean_nees) return;
  json["nees_dof"] = errors.nees.dof();
  json["nees_independent"] = orNull(errors.nees.effectiveCount());
  if (const auto& c = errors.consistency) {
    json["nees_low"] = orNull(c->band.low);
    json["nees_high"] = orNull(c->band.high);
    json["sd_factor"] = orNull(c->sd_factor);
    json["verdict"] = c->verdict;
  } else {
    json["verdict"] = "not judged: the estimate was laid onto the truth";
  }
}

Json toJson(const SensorCounts& counts) {
  Json refused = Json::object();
  for (const auto& [reason, count] : counts.refused) refused[reason] = count;
  Json json = {{"read", counts.read},
               {"used", counts.used},
               {"refused", refused},
               {"mean_nis", orNull(counts.mean_nis)},
               {"nis_dof", counts.nis_dof}};
  if (const auto& c = counts.consistency) {
    json["nis_independent"] = orNull(counts.nis_independent);
    json["nis_expected"] = orNull(c->band.expected);
    json["nis_low"] = orNull(c->band.low);
    json["nis_high"] = orNull(c->band.high);
    json["sd_factor"] = orNull(c->sd_factor);
    json["verdict"] = c->verdict;
  }
  return json;
}

std::string cell(const std::optional<double>& value, int decimals) {
  std::array<char, 400> text;
  if (value && std::isfinite(*value))
    std::snprintf(text.data(), text.size(), "%16.*f", decimals, *value);
  else
    std::snprintf(text.data(), text.size(), "%16s", "-");
  return text.data();
}

/// The metrics that have a column in the table.
const Metrics<TrajectoryErrors>& columns() {
  static const Metrics<TrajectoryErrors> rows = [] {
    Metrics<TrajectoryErrors> out = errorMetrics();
    out.insert(out.end(), neesMetrics().begin(), neesMetrics().end());
    std::erase_if(out, [](const auto& row) { return row.info.alias.empty(); });
    return out;
  }();
  return rows;
}

std::string tableRow(const std::string& title, const TrajectoryErrors& errors) {
  std::string row = title;
  for (const auto& c : columns()) row += cell(c.value(errors), c.info.unit == "m" ? 3 : 2);
  return row + "\n";
}

}  // namespace

std::string metricsJson(const LocalizationMetrics& metrics) {
  Json json;
  json["duration_s"] = orNull(metrics.duration_s);
  json["wall_s"] = orNull(metrics.wall_s);
  json["peak_memory_mb"] = orNull(metrics.peak_memory_mb);
  json["truth_source"] = metrics.truth_source;
  json["estimate"] = toJson(metrics.estimate);
  if (metrics.estimate) addNees(json["estimate"], *metrics.estimate);
  json["odometry"] = toJson(metrics.odometry);
  json["sensors"] = Json::object();
  for (const auto& [label, counts] : metrics.sensors) json["sensors"][label] = toJson(counts);
  if (metrics.most_modes) {
    json["most_modes"] = *metrics.most_modes;
    json["several_modes_share"] = orNull(metrics.several_modes_share);
  }
  json["partial"] = metrics.partial;
  json["warnings"] = metrics.warnings;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writeMetrics(const LocalizationMetrics& metrics, const std::string& file) {
  std::ofstream stream(file, std::ios::binary);
  if (!stream) throw DatasetError::missing(file + ": cannot be written: " + std::strerror(errno));
  stream << metricsJson(metrics);
  stream.close();
  if (!stream) throw DatasetError::missing(file + ": could not be written to its end: " + std::strerror(errno));
}

std::string errorTable(const LocalizationMetrics& metrics) {
  std::string table = "          ";
  for (const auto& c : columns()) table += std::string(16 - c.info.alias.size(), ' ') + c.info.alias;
  table += "\n";
  if (metrics.odometry) table += tableRow("odometry  ", *metrics.odometry);
  if (metrics.estimate) table += tableRow("estimate  ", *metrics.estimate);
  if (metrics.estimate && metrics.estimate->consistency)
    table += consistencyLine("estimate", "NEES", *metrics.estimate->mean_nees, *metrics.estimate->consistency) + "\n";
  for (const auto& [label, counts] : metrics.sensors)
    if (counts.consistency) table += consistencyLine(label, "NIS", *counts.mean_nis, *counts.consistency) + "\n";
  return table;
}

double peakMemoryMb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

}  // namespace sidestep
