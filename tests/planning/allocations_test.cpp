// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "support/allocations.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

namespace {
std::atomic<long> allocations = 0;
}  // namespace

// Counts what the planners allocate: the sanitizers' allocator stays beneath.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {  // std::stable_sort's
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace sidestep::testing {

long allocationsSoFar() { return allocations; }

TEST(Allocations, AreCounted) {
  const long before = allocationsSoFar();
  const auto one = std::make_unique<int>(1);
  EXPECT_EQ(allocationsSoFar() - before, *one);
}

TEST(Allocations, ThoseThatMayFailAreCountedToo) {
  const long before = allocationsSoFar();
  int* one = new (std::nothrow) int(1);
  ASSERT_NE(one, nullptr);
  EXPECT_EQ(allocationsSoFar() - before, *one);
  delete one;
}

}  // namespace sidestep::testing
