// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-rawlog/rawlog_report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

namespace sidestep {
namespace {

using Json = nlohmann::ordered_json;

[[gnu::format(printf, 1, 2)]] std::string format(const char* pattern, ...) {
  char text[512];
  va_list values;
  va_start(values, pattern);
  std::vsnprintf(text, sizeof(text), pattern, values);
  va_end(values);
  return text;
}

std::string date(double time_s) {
  const auto whole = static_cast<std::time_t>(time_s);
  std::tm utc{};
  char text[40] = "";
  if (gmtime_r(&whole, &utc) != nullptr) std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M:%S UTC", &utc);
  return text;
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string labelRow(const std::string& label, const LabelHealth& h, double log_start_s) {
  const std::string gap =
      h.count < 2 ? "-" : format("%.3g s at %.1f s", h.largest_gap_s, h.largest_gap_at_s - log_start_s);
  return format("  %-18s %-13s %-26s %8llu %9.3f %10.4g %9.3g %6llu  ", printable(label).c_str(), word(h.kind).c_str(),
                h.class_name.c_str(), static_cast<unsigned long long>(h.count), h.rate_hz, h.period_s, h.jitter_s,
                static_cast<unsigned long long>(h.gaps)) +
         gap + "\n";
}

Json labelJson(const LabelHealth& h) {
  return {{"class", h.class_name},
          {"kind", word(h.kind)},
          {"count", h.count},
          {"first_s", h.first_s},
          {"last_s", h.last_s},
          {"rate_hz", h.rate_hz},
          {"period_s", h.period_s},
          {"jitter_s", h.jitter_s},
          {"largest_gap_s", h.largest_gap_s},
          {"largest_gap_at_s", h.largest_gap_at_s},
          {"gaps", h.gaps},
          {"repeated_stamps", h.repeated_stamps}};
}

}  // namespace

std::string printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

std::string healthText(const LogHealth& health) {
  std::string out = printable(health.file) + "\n";
  out +=
      format("  format    %s, %llu bytes\n", health.format.c_str(), static_cast<unsigned long long>(health.file_bytes));
  out += format("  entries   %llu, %llu bytes uncompressed\n", static_cast<unsigned long long>(health.end.entries),
                static_cast<unsigned long long>(health.end.bytes));
  if (!health.labels.empty())
    out += format("  time      %.3f s from %s\n", health.last_s - health.first_s, date(health.first_s).c_str());
  out += format("\n  %-18s %-13s %-26s %8s %9s %10s %9s %6s  %s\n", "label", "kind", "class", "count", "rate Hz",
                "period s", "jitter s", "gaps", "largest gap");
  for (const auto& [label, h] : health.labels) out += labelRow(label, h, health.first_s);
  out += "\n  " + word(health.verdict) + "\n";
  for (const std::string& reason : health.reasons) out += "    - " + printable(reason) + "\n";
  return out;
}

std::string healthJson(const LogHealth& health) {
  Json json{{"file", health.file},
            {"format", health.format},
            {"file_bytes", health.file_bytes},
            {"entries", health.end.entries},
            {"bytes", health.end.bytes},
            {"first_s", health.first_s},
            {"last_s", health.last_s},
            {"duration_s", health.last_s - health.first_s},
            {"verdict", word(health.verdict)},
            {"damage", health.end.message},
            {"reasons", health.reasons},
            {"labels", Json::object()},
            {"refused", health.refused}};
  for (const auto& [label, h] : health.labels) json["labels"][label] = labelJson(h);
  return dump(json);
}

std::string recoveryText(const RecoveryReport& r, const std::string& out) {
  std::string text = format("%llu entries (%llu bytes) written to ", static_cast<unsigned long long>(r.entries),
                            static_cast<unsigned long long>(r.bytes)) +
                     out + "\n";
  if (r.breaks == 0) return text + "nothing was missing\n";
  return text +
         format("%llu breaks, the first: %s\n%llu bytes lost", static_cast<unsigned long long>(r.breaks),
                r.first_damage.c_str(), static_cast<unsigned long long>(r.lost_bytes)) +
         (r.skipped_bytes > 0 ? format(", and %llu compressed bytes that could not be inflated\n",
                                       static_cast<unsigned long long>(r.skipped_bytes))
                              : std::string("\n"));
}

std::string recoveryJson(const RecoveryReport& r, const std::string& out) {
  return dump({{"output", out},
               {"entries", r.entries},
               {"bytes", r.bytes},
               {"lost_bytes", r.lost_bytes},
               {"skipped_compressed_bytes", r.skipped_bytes},
               {"breaks", r.breaks},
               {"first_damage", r.first_damage}});
}

std::string degradeText(const DegradeReport& r, const std::string& out) {
  std::string text = format("%llu of %llu observations written to ", static_cast<unsigned long long>(r.written),
                            static_cast<unsigned long long>(r.read)) +
                     out + "\n";
  for (const auto& e : r.events)
    text += "  " + printable(e.name) +
            format(": met %llu, hit %llu\n", static_cast<unsigned long long>(e.met),
                   static_cast<unsigned long long>(e.hit));
  return text;
}

std::string degradeJson(const DegradeReport& r, const std::string& out) {
  Json json{{"output", out}, {"read", r.read}, {"written", r.written}, {"events", Json::object()}};
  for (const auto& e : r.events) json["events"][e.name] = {{"met", e.met}, {"hit", e.hit}};
  return dump(json);
}

}  // namespace sidestep
