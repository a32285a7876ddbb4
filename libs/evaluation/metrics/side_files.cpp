// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/side_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sidestep {

void LostFile::write(const Estimate& e) {
  if (!e.lost_probability) return;
  if (!file_.is_open()) {
    file_.open(name_);
    file_ << "time_s,probability\n";
  }
  std::array<char, 64> row;
  std::snprintf(row.data(), row.size(), "%.6f,%.6f\n", e.time_s, *e.lost_probability);
  file_ << row.data();
}

void ModesFile::write(const Estimate& e) {
  if (e.modes.empty()) return;
  if (!file_.is_open()) {
    file_.open(name_);
    file_ << "time_s,weight,x_m,y_m,yaw_deg,sd_x_m,sd_y_m,sd_yaw_deg\n";
  }
  ++looks_;
  several_ += e.modes.size() > 1;
  most_ = std::max<uint64_t>(most_, e.modes.size());
  for (const auto& m : e.modes) {
    const auto& p = m.belief.mean;
    const Eigen::Vector3d sd = m.belief.covariance.diagonal().cwiseMax(0).cwiseSqrt();
    std::array<char, 300> row;
    std::snprintf(row.data(), row.size(), "%.6f,%.4f,%.4f,%.4f,%.3f,%.4f,%.4f,%.3f\n", e.time_s, m.weight, p.x, p.y,
                  p.phi * 180 / M_PI, sd(0), sd(1), sd(2) * 180 / M_PI);
    file_ << row.data();
  }
}

void ModesFile::into(LocalizationMetrics& metrics) const {
  if (looks_ == 0) return;
  metrics.most_modes = most_;
  metrics.several_modes_share = static_cast<double>(several_) / static_cast<double>(looks_);
}

void InnovationLog::take(Localizer& localizer) {
  for (const auto& r : localizer.takeInnovations())
    tracks_[localizer.sensors()[static_cast<size_t>(r.stream)].label].add(r.time_s, r.nis, r.dof, r.accepted);
}

ConsistencyFigure InnovationLog::figure(const LocalizationMetrics& metrics, double gate_probability) const {
  ConsistencyFigure out;
  if (metrics.estimate) {
    out.errors = metrics.estimate->nees;
    out.verdict = metrics.estimate->consistency ? metrics.estimate->consistency->verdict
                                                : "not judged, the estimate was laid onto the truth";
  }
  for (const auto& [label, track] : tracks_) {
    const auto it = metrics.sensors.find(label);
    if (it == metrics.sensors.end() || it->second.used == 0) continue;
    const double share = it->second.nis_independent / static_cast<double>(it->second.used);
    out.sensors.push_back({label, track, share < 0.999 ? 1 : gate_probability, std::min(1.0, share),
                           it->second.consistency ? it->second.consistency->verdict : ""});
  }
  return out;
}

}  // namespace sidestep
