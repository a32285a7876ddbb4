// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/process_limits.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace sidestep::testing {
namespace {

/// What waitpid says of a child that does `work`, which must end it.
template <class Work>
int statusOfChild(const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    _exit(9);
  }
  int status = -1;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

/// Whether the kernel still gives that much; not asked of malloc, which a sanitizer replaces.
bool obtains(size_t bytes) {
  return mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
}

TEST(ProcessLimits, MemoryIsLimitedOnTopOfWhatIsMapped) {
  const int status = statusOfChild([] {
    limitMemory(64u << 20);
    const bool little = obtains(16u << 20), much = obtains(256u << 20);
    _exit(little && !much ? 0 : 1);
  });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(ProcessLimits, AProcessThatComputesForEverIsEnded) {
  const int status = statusOfChild([] {
    limitCpuTime(0.02);
    for (volatile int turning = 1; turning != 0;) turning = 1;
  });
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGPROF);
}

TEST(ProcessLimits, ZeroTakesTheLimitOfCpuTimeAway) {
  const int status = statusOfChild([] {
    limitCpuTime(100);
    limitCpuTime(0);
    itimerval timer{};
    getitimer(ITIMER_PROF, &timer);
    _exit(timer.it_value.tv_sec == 0 && timer.it_value.tv_usec == 0 ? 0 : 1);
  });
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace sidestep::testing
