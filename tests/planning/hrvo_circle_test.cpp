// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Antipodal circles: each of n agents goes to the place opposite its own.
#include <gtest/gtest.h>

#include "support/antipodal_circle.h"

namespace sidestep::testing {
namespace {

void expectCleanExchange(int agents) {
  const auto result = support::antipodalCircle(agents, {});
  EXPECT_EQ(result.colliding_pairs, 0);
  EXPECT_EQ(result.arrived, agents) << "after " << result.time_s << " s";
  EXPECT_GE(result.least_gap_m, 0);
}

TEST(HrvoCircle, TenAgentsExchangePlacesWithoutTouching) { expectCleanExchange(10); }
TEST(HrvoCircle, FiftyAgentsExchangePlacesWithoutTouching) { expectCleanExchange(50); }
TEST(HrvoCircle, TwoHundredAgentsExchangePlacesWithoutTouching) { expectCleanExchange(200); }

}  // namespace
}  // namespace sidestep::testing
