// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/log_health.h"

#include <mrpt/obs/CObservation.h>

#include <cstdio>
#include <fstream>

#include "datasets/log_histogram.h"

namespace sidestep {
namespace {

constexpr double kGapPeriods = 5;
constexpr size_t kMostLabels = 1000;

struct Tally {
  LabelHealth health;
  LogHistogram periods;
};

void add(Tally& tally, const Reading& entry) {
  LabelHealth& h = tally.health;
  h.kind = entry.kind;
  if (h.count++ == 0) {
    h.class_name = entry.observation->GetRuntimeClass()->className;
    h.class_name.erase(0, h.class_name.rfind(':') + 1);
    h.first_s = h.last_s = entry.time_s;
    return;
  }
  const double period = entry.time_s - h.last_s;
  if (period > 0) tally.periods.add(period);
  if (period <= 0) ++h.repeated_stamps;
  if (period > h.largest_gap_s) {
    h.largest_gap_s = period;
    h.largest_gap_at_s = h.last_s;
  }
  h.last_s = entry.time_s;
}

LabelHealth conclude(Tally tally) {
  LabelHealth& h = tally.health;
  if (h.last_s > h.first_s) h.rate_hz = static_cast<double>(h.count - 1) / (h.last_s - h.first_s);
  h.period_s = tally.periods.quantile(0.5);
  h.jitter_s = 0.5 * (tally.periods.quantile(0.95) - tally.periods.quantile(0.05));
  h.gaps = h.period_s > 0 ? tally.periods.countAbove(kGapPeriods * h.period_s) : 0;
  return h;
}

std::string formatOf(const std::string& file, bool frames) {
  char magic[2] = {0, 0};
  std::ifstream(file, std::ios::binary).read(magic, 2);
  const bool gzip = magic[0] == '\x1f' && magic[1] == '\x8b';
  return std::string(gzip ? "gzip, " : "plain, ") + (frames ? "actions and sensory frames" : "observations");
}

std::string seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g s", s);
  return text;
}

void judge(LogHealth& health) {
  for (const auto& [label, reasons] : health.refused)
    for (const auto& [reason, count] : reasons)
      health.reasons.push_back(label + ": " + std::to_string(count) + " refused, " + reason);
  for (const auto& [label, h] : health.labels)
    if (h.gaps > 0)
      health.reasons.push_back(label + ": " + std::to_string(h.gaps) + " gaps, the largest " +
                               seconds(h.largest_gap_s) + " where " + seconds(h.period_s) + " is usual");
  for (const auto& [label, h] : health.labels)
    if (h.repeated_stamps > 0)
      health.reasons.push_back(label + ": " + std::to_string(h.repeated_stamps) + " stamps repeated");
  if (health.labels.empty()) health.reasons.push_back("no observation passed the screening");
  if (!health.reasons.empty()) health.verdict = Verdict::kUsableWithCare;
  if (!health.end.damaged) return;
  health.verdict = Verdict::kDamaged;
  health.reasons.insert(health.reasons.begin(), health.end.message);
}

}  // namespace

std::string word(Verdict verdict) {
  if (verdict == Verdict::kHealthy) return "healthy";
  return verdict == Verdict::kDamaged ? "damaged" : "usable with care";
}

LogHealth examineLog(const std::string& file, const LogReaderOptions& options,
                     const std::function<void(uint64_t, uint64_t)>& progress) {
  LogReader reader(file, options);
  LogHealth health;
  std::map<std::string, Tally> tallies;
  uint64_t n = 0;
  while (const auto entry = reader.next()) {
    const bool room = tallies.size() < kMostLabels || tallies.contains(entry->label);
    add(tallies[room ? entry->label : "(more)"], *entry);
    if (n == 0) health.first_s = entry->time_s;
    health.last_s = entry->time_s;
    if (++n % 1000 == 0 && progress) progress(reader.bytesConsumed(), reader.fileSize());
  }
  for (auto& [label, tally] : tallies) health.labels[label] = conclude(std::move(tally));
  health.file = file;
  health.file_bytes = reader.fileSize();
  health.format = formatOf(file, reader.isFrameLayout());
  health.end = reader.end();
  health.refused = reader.refused();
  judge(health);
  return health;
}

}  // namespace sidestep
