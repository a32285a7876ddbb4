// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Random problems into the band planners:  fuzz_band_planner [--problems 1000000] [--seed 1]
// Says after every 10000 how far it is; stops at the first command that is not finite or beyond a limit and at the
// first band that diverges on finite input, naming the seed that makes it again.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/band_scenes.h"

int main(int argc, char** argv) {
  unsigned long long problems = 1000000, seed = 1;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--problems") == 0) problems = std::strtoull(argv[i + 1], nullptr, 10);
    if (std::strcmp(argv[i], "--seed") == 0) seed = std::strtoull(argv[i + 1], nullptr, 10);
  }
  sidestep::support::FuzzCount count;
  for (unsigned long long k = 0; k < problems; ++k) {
    const std::string wrong = sidestep::support::fuzzBandPlanner(seed + k, count);
    if (!wrong.empty()) {
      std::printf("seed %llu: %s\n", seed + k, wrong.c_str());
      return 1;
    }
    if ((k + 1) % 10000 != 0) continue;
    std::printf("%llu problems\n", k + 1);
    std::fflush(stdout);
  }
  std::printf(
      "%llu problems from seed %llu, %d plans: commands finite and inside the limits; %d braked, %d at the goal, "
      "%d bands diverged on input that was not finite\n",
      problems, seed, count.plans, count.braked, count.reached, count.diverged);
  return 0;
}
