// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/problem_file.h"

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "core/errors.h"

namespace sidestep {
namespace {

/// The numbers of a row, or nothing if there are not `count` of them, finite.
std::vector<double> numbersIn(const std::string& line, size_t count) {
  std::vector<double> out;
  const char* at = line.c_str();
  while (out.size() < count) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at || !std::isfinite(value) || std::abs(value) > 1e6) return {};
    out.push_back(value);
    const bool last = out.size() == count;
    if (last ? (*end != 0 && *end != '\r') : *end != ',') return {};
    at = end + 1;
  }
  return out;
}

}  // namespace

std::vector<PlanningProblem> readProblems(const std::string& file, bool with_count, double radius_m) {
  std::ifstream in(file);
  if (!in) throw DatasetError::missing(file + ": cannot be read; --problems wants a CSV");
  const std::string header = with_count ? "n_obs,seed,i,x,y,vx,vy" : "seed,i,x,y,vx,vy";
  std::string line;
  std::getline(in, line);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line != header) throw DatasetError::corrupt(file + ":1: the first line must be " + header);
  std::vector<PlanningProblem> out;
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const auto row = numbersIn(line, with_count ? 7 : 6);
    if (row.empty())
      throw DatasetError::corrupt(file + ":" + std::to_string(number) + ": not " + header + " as finite numbers");
    const size_t at = with_count ? 1 : 0;
    const int n_obs = with_count ? static_cast<int>(row[0]) : 0, seed = static_cast<int>(row[at]);
    if (out.empty() || out.back().seed != seed || out.back().n_obs != n_obs) out.push_back({n_obs, seed, {}});
    MovingObstacle o;
    o.id = static_cast<int>(row[at + 1]);
    o.position = {row[at + 2], row[at + 3]};
    o.velocity = {row[at + 4], row[at + 5]};
    o.radius_m = radius_m;
    out.back().obstacles.push_back(o);
  }
  if (out.empty()) throw DatasetError::corrupt(file + ": holds no problem");
  return out;
}

}  // namespace sidestep
