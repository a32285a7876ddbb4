// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What is installed is enough for somebody's own program, and holds no more headers than are listed.
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

/// All that is installed below `prefix`, by a build as it stands.
ProgramResult install(const std::filesystem::path& prefix) {
  return runShell("cmake --install '" SIDESTEP_BUILD "' --prefix '" + prefix.string() + "'");
}

/// Configures, builds and runs tests/contracts/consumer against `prefix`, with the compiler and flags of this build.
ProgramResult runConsumer(const std::filesystem::path& folder, const std::filesystem::path& prefix) {
  return runShell("cmake -S '" SIDESTEP_SOURCE "/tests/contracts/consumer' -B '" + folder.string() +
                      "' -DCMAKE_PREFIX_PATH='" + prefix.string() +
                      "' -DCMAKE_CXX_COMPILER='" SIDESTEP_CXX "' -DCMAKE_CXX_FLAGS='" SIDESTEP_CXX_FLAGS
                      "' >configure.log 2>&1 || { cat configure.log; exit 1; }\n"
                      "cmake --build . >build.log 2>&1 || { cat build.log; exit 1; }\n"
                      "./consumer",
                  folder);
}

TEST(Install, AProgramOfAUsersOwnCompilesAndRunsAgainstTheInstalledHeadersAlone) {
  const TemporaryFolder prefix, build;
  const auto installed = install(prefix.path());
  ASSERT_EQ(installed.exit_code, 0) << installed.out << installed.err;
  const auto consumer = runConsumer(build.path(), prefix.path());
  EXPECT_EQ(consumer.exit_code, 0) << consumer.err;
  EXPECT_EQ(consumer.out, "10 readings, drives\n");
}

TEST(Install, NoHeaderComesAlongThatIsNotListed) {
  const TemporaryFolder prefix;
  ASSERT_EQ(install(prefix.path()).exit_code, 0);
  const std::string list = readFile(std::filesystem::path(SIDESTEP_SOURCE) / "cmake" / "SidestepPublicHeaders.cmake");
  int headers = 0;
  const auto include = prefix.path() / "include" / "sidestep";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(include)) {
    if (entry.is_directory()) continue;
    const auto name = entry.path().lexically_relative(include).string();
    EXPECT_NE(list.find(name), std::string::npos) << name;
    ++headers;
  }
  EXPECT_GT(headers, 20);
}

}  // namespace
}  // namespace sidestep::testing
