// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The logs that come with the project are what their commands make.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

using Json = nlohmann::json;

const std::filesystem::path kRawlogs = std::filesystem::path(SIDESTEP_SOURCE) / "rawlogs";

Json infoOf(const std::filesystem::path& log) {
  const auto run = runShell("sidestep-rawlog info --json '" + log.string() + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return Json::parse(run.out);
}

TEST(Rawlogs, EachIsInTheListWithTheCommandThatMakesItAgain) {
  static const std::regex row("\\| `([a-z0-9-]+)\\.rawlog` \\| `(sidestep-simulate [^`]* -o ([a-z0-9-]+))` \\|");
  std::map<std::string, std::pair<std::string, std::string>> commands;
  for (const auto& line : linesOf(readFile(kRawlogs / "README.md"))) {
    std::smatch match;
    if (std::regex_search(line, match, row)) commands[match[1]] = {match[2], match[3]};
  }
  const TemporaryFolder folder;
  std::filesystem::create_directory_symlink(std::filesystem::path(SIDESTEP_SOURCE) / "share", folder / "share");
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRawlogs)) {
    if (entry.path().extension() != ".rawlog") continue;
    ++files;
    ASSERT_EQ(commands.count(entry.path().stem()), 1u) << entry.path();
    const auto& [command, output] = commands.at(entry.path().stem());
    const auto run = runShell(command, folder.path());
    ASSERT_EQ(run.exit_code, 0) << run.err;
    // Libraries round sines otherwise on other processors, which may move an arrival; hence no comparison of bytes.
    const Json kept = infoOf(entry.path()), made = infoOf(folder / output / "run.rawlog");
    const double entries = made.at("entries");
    EXPECT_NEAR(kept.at("entries"), entries, 0.02 * entries) << entry.path();
    EXPECT_EQ(kept.at("labels").size(), made.at("labels").size()) << entry.path();
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace sidestep::testing
