// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

TEST(Labels, AreAskedForInTheSameWordsByEveryProgram) {
  const std::string log = " " SIDESTEP_SOURCE "/tests/data/whole-gzip.rawlog ";
  for (const std::string program : {"sidestep-rawlog info", "sidestep-localize"}) {
    EXPECT_NE(runShell(program + log + "--label gpx=A").err.find("did you mean 'gps'?"), std::string::npos) << program;
    EXPECT_NE(runShell(program + log + "--label gps").err.find("write it as kind=label"), std::string::npos) << program;
    const auto twice = runShell(program + log + "--label gps=A --label gps=B");
    EXPECT_NE(twice.err.find("gps is given twice"), std::string::npos) << twice.err;
    EXPECT_EQ(twice.exit_code, 2);
  }
}

}  // namespace
}  // namespace sidestep::testing
