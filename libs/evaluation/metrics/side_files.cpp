// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/metrics/side_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sidestep {
namespace {

constexpr size_t kMostBlocks = 40;

std::string ending(const std::string& verdict) { return verdict.empty() ? "" : ": " + verdict; }

ConsistencyFigure::Panel neesPanel(const NormalizedErrors& errors, const std::string& verdict) {
  const auto& kept = errors.kept();
  ConsistencyFigure::Panel out;
  out.title = "NEES, " + std::to_string(errors.dof()) + " degrees of freedom" + ending(verdict);
  out.expected = errors.dof();
  for (const auto& s : kept) out.values.push_back({s.time_s, s.nees(), true});
  const double n_eff_share = errors.effectiveCount() / static_cast<double>(kept.size());
  const size_t size = std::max<size_t>(1, (kept.size() + kMostBlocks - 1) / kMostBlocks);
  for (size_t from = 0; from < kept.size(); from += size) {
    const size_t to = std::min(kept.size(), from + size);
    double sum = 0;
    for (size_t i = from; i < to; ++i) sum += kept[i].nees();
    const double n = static_cast<double>(to - from);
    const auto band = neesBand(std::max(1.0, n * n_eff_share), errors.dof());
    out.means.push_back({0.5 * (kept[from].time_s + kept[to - 1].time_s), sum / n, band.low, band.high});
  }
  return out;
}

/// @param n_eff_share  effective samples by measurements
ConsistencyFigure::Panel nisPanel(const std::string& label, const NisTrack& track, double gate_probability,
                                  double n_eff_share, const std::string& verdict) {
  ConsistencyFigure::Panel out;
  out.title = "NIS of " + label + ", " + std::to_string(track.dof()) +
              (track.dof() == 1 ? " degree of freedom" : " degrees of freedom") + ending(verdict);
  out.expected = nisBand(100, track.dof(), gate_probability).expected;
  out.values = track.points();
  for (const auto& b : track.blocks()) {
    const auto band = nisBand(static_cast<double>(b.count) * n_eff_share, track.dof(), gate_probability);
    out.means.push_back({0.5 * (b.from_s + b.to_s), b.sum / static_cast<double>(b.count), band.low, band.high});
  }
  return out;
}

}  // namespace

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
  if (metrics.estimate && !metrics.estimate->nees.kept().empty()) {
    const auto& c = metrics.estimate->consistency;
    out.panels.push_back(
        neesPanel(metrics.estimate->nees, c ? c->verdict : "not judged, the estimate was laid onto the truth"));
  }
  for (const auto& [label, track] : tracks_) {
    const auto it = metrics.sensors.find(label);
    if (it == metrics.sensors.end() || it->second.used == 0 || track.blocks().empty()) continue;
    const double share = it->second.nis_independent / static_cast<double>(it->second.used);
    out.panels.push_back(nisPanel(label, track, share < 0.999 ? 1 : gate_probability, std::min(1.0, share),
                                  it->second.consistency ? it->second.consistency->verdict : ""));
  }
  return out;
}

}  // namespace sidestep
