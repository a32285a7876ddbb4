// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sidestep::testing {

/// How often this test program has asked for memory (allocations_test.cpp of its folder counts).
long allocationsSoFar();

}  // namespace sidestep::testing
