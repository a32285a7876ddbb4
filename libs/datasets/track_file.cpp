// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/track_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/errors.h"

namespace sidestep {
namespace {

/// Four finite numbers between commas, or nothing.
std::optional<std::array<double, 4>> numbersOf(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::array<double, 4> out{};
  const char *at = line.data(), *end = line.data() + line.size();
  for (size_t i = 0; i < out.size(); ++i) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, out[i]);
    if (error != std::errc() || !std::isfinite(out[i])) return std::nullopt;
    at = next;
    while (at != end && *at == ' ') ++at;
    const bool last = i + 1 == out.size();
    if (last != (at == end) || (!last && *at++ != ',')) return std::nullopt;
  }
  return out;
}

}  // namespace

std::map<int, std::vector<TrackRow>> readTracks(const std::string& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file))
    throw DatasetError::missing(file + ": cannot be read as recorded people; check the path");
  std::map<int, std::vector<TrackRow>> out;
  uint64_t number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    const auto n = numbersOf(line);
    if (!n && number == 1) continue;  // the heading line
    if (!n || std::abs((*n)[1]) > 1e9 || (*n)[1] != std::floor((*n)[1]))
      throw DatasetError::corrupt(file + ":" + std::to_string(number) +
                                  ": wants t,id,x,y: four numbers, id a whole one");
    out[static_cast<int>((*n)[1])].push_back({(*n)[0], (*n)[2], (*n)[3]});
  }
  for (auto& [id, rows] : out) {
    std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
    for (size_t i = 1; i < rows.size(); ++i)
      if (rows[i].time_s == rows[i - 1].time_s)
        throw DatasetError::corrupt(file + ": id " + std::to_string(id) +
                                    " is at two places at t = " + std::to_string(rows[i].time_s));
  }
  return out;
}

}  // namespace sidestep
