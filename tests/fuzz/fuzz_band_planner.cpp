// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Random problems into the band planners:  fuzz_band_planner [--problems 1000000] [--seed 1]
// Stops at the first command that is not finite or beyond a limit, naming the seed that makes it again.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/band_scenes.h"

int main(int argc, char** argv) {
  uint64_t problems = 1000000, seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--problems") == 0) problems = std::strtoull(argv[i + 1], nullptr, 10);
    if (std::strcmp(argv[i], "--seed") == 0) seed = std::strtoull(argv[i + 1], nullptr, 10);
  }
  int braked = 0;
  for (uint64_t k = 0; k < problems; ++k) {
    const std::string wrong = sidestep::support::fuzzBandPlanner(seed + k, braked);
    if (!wrong.empty()) {
      std::printf("seed %llu: %s\n", static_cast<unsigned long long>(seed + k), wrong.c_str());
      return 1;
    }
  }
  std::printf("%llu problems, 4 plans each: all commands finite and inside the limits; %d plans braked\n",
              static_cast<unsigned long long>(problems), braked);
  return 0;
}
