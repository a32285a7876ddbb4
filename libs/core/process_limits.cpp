// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/process_limits.h"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace sidestep {
namespace {

uint64_t addressSpaceInUse() {
  unsigned long pages = 0;
  FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  const bool ok = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  return ok ? pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace

void limitMemory(size_t bytes) {
  const uint64_t limit = addressSpaceInUse() + bytes;
  const rlimit as{limit, limit}, no_core{0, 0};
  setrlimit(RLIMIT_AS, &as);
  setrlimit(RLIMIT_CORE, &no_core);
}

void limitCpuTime(double seconds) {
  itimerval timer{};
  double whole = 0;
  const double part = std::modf(seconds, &whole);
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>(part * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace sidestep
