// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Habits that all programs share: help with an example that runs, files and options that explain themselves.
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

/// The command lines under "Example": indented by two blanks, a backslash at the end joins the next line.
std::vector<std::string> exampleCommands(const std::string& help) {
  std::vector<std::string> out;
  bool inside = false, joined = false;
  for (const auto& line : linesOf(help)) {
    if (!line.starts_with("  ")) {
      inside = line.starts_with("Example");
      joined = false;
      continue;
    }
    if (!inside) continue;
    std::string words = line.substr(line.find_first_not_of(' '));
    const bool more = words.ends_with("\\");
    if (more) words.pop_back();
    if (joined)
      out.back() += words;
    else
      out.push_back(words);
    joined = more;
  }
  return out;
}

/// A folder in which examples may write, with the source tree's data where they expect it.
void prepareForExamples(const TemporaryFolder& folder) {
  for (const char* name : {"share", "rawlogs", "tests"}) {
    const auto there = std::filesystem::path(SIDESTEP_SOURCE) / name;
    if (std::filesystem::exists(there)) std::filesystem::create_directory_symlink(there, folder / name);
  }
}

TEST(Programs, AreBuilt) {
  const auto all = programs();
  for (const char* name :
       {"sidestep-evaluate", "sidestep-localize", "sidestep-plan", "sidestep-rawlog", "sidestep-simulate"})
    EXPECT_EQ(std::count(all.begin(), all.end(), name), 1) << name;
}

TEST(Programs, HelpShowsAnExampleThatItselfRuns) {
  for (const auto& program : programs()) {
    const auto help = runShell(program + " --help");
    ASSERT_EQ(help.exit_code, 0) << program << help.err;
    EXPECT_FALSE(exampleCommands(help.out).empty()) << program << " --help shows no example:\n" << help.out;
    auto commands = exampleCommands(wholeHelp(program));
    std::sort(commands.begin(), commands.end());
    commands.erase(std::unique(commands.begin(), commands.end()), commands.end());
    const TemporaryFolder folder;
    prepareForExamples(folder);
    for (const auto& command : commands) {
      EXPECT_TRUE(command.starts_with("sidestep-")) << command;
      const auto run = runShell(command, folder.path());
      EXPECT_EQ(run.exit_code, 0) << command << "\n" << run.out << run.err;
    }
  }
}

TEST(Programs, EachSubcommandHasHelp) {
  for (const auto& program : programs())
    for (const auto& sub : subcommandsIn(runShell(program + " --help").out)) {
      const auto help = runShell(program + " " + sub + " --help");
      EXPECT_EQ(help.exit_code, 0) << program << " " << sub;
      EXPECT_NE(help.out, "") << program << " " << sub;
    }
}

TEST(Programs, SayTheirVersion) {
  for (const auto& program : programs()) {
    const auto run = runShell(program + " --version");
    EXPECT_EQ(run.exit_code, 0) << program;
    EXPECT_TRUE(std::regex_match(run.out, std::regex(program + " [0-9]+\\.[0-9]+\\.[0-9]+\n"))) << run.out;
  }
}

TEST(Programs, AMisspeltOptionIsAnErrorThatNamesTheNearest) {
  for (const auto& program : programs()) {
    const auto run = runShell(program + " --versoin");
    EXPECT_EQ(run.exit_code, 2) << program;
    EXPECT_EQ(linesOf(run.err).size(), 1u) << run.err;
    EXPECT_NE(run.err.find("did you mean --version?"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  }
  const auto run = runShell("sidestep-localize log.rawlog --sensrs odometry");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("did you mean --sensors?"), std::string::npos) << run.err;
}

TEST(Programs, AMisspeltKeyIsAnErrorWithFileLineAndTheNearestKey) {
  const TemporaryFolder folder;
  writeFile(folder / "robot.yaml", "filter: ekf\nekf:\n  gate: true\n  gate_patiense_s: 3\n");
  const auto run = runShell("sidestep-localize -c robot.yaml --write-config", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(linesOf(run.err).size(), 1u) << run.err;
  EXPECT_NE(run.err.find("robot.yaml:4: ekf.gate_patiense_s is no known key; did you mean 'gate_patience_s'?"),
            std::string::npos)
      << run.err;
}

TEST(Programs, AValueOutOfRangeIsAnErrorThatSaysWhatIsAllowed) {
  const TemporaryFolder folder;
  writeFile(folder / "robot.yaml", "gps: {sd_m: -3}\n");
  const auto run = runShell("sidestep-localize -c robot.yaml --write-config", folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("robot.yaml:1: gps.sd_m = -3 m, allowed 0.001 .. 1000"), std::string::npos) << run.err;
}

TEST(Programs, AMissingConfigurationFileIsAMissingInput) {
  const auto run = runShell("sidestep-localize -c /no/such/file.yaml --write-config");
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_EQ(linesOf(run.err).size(), 1u) << run.err;
}

TEST(Programs, WhatWriteConfigPrintsReadsBackIdentically) {
  for (const auto& program : programs()) {
    if (optionsIn(runShell(program + " --help").out).count("--write-config") == 0) continue;
    const TemporaryFolder folder;
    const auto first = runShell(program + " --write-config");
    ASSERT_EQ(first.exit_code, 0) << program << first.err;
    ASSERT_NE(first.out, "");
    writeFile(folder / "config.yaml", first.out);
    const auto second = runShell(program + " -c config.yaml --write-config", folder.path());
    EXPECT_EQ(second.exit_code, 0) << second.err;
    EXPECT_EQ(second.out, first.out);
  }
}

}  // namespace
}  // namespace sidestep::testing
