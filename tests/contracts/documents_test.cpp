// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// What the documents say of the programs is true.
#include <gtest/gtest.h>

#include "localization/configuration.h"
#include "planning/band/band_planner.h"
#include "sidestep-plan/path_config.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const std::filesystem::path kSource = SIDESTEP_SOURCE;

/// README.md and its like, and all of doc/.
std::vector<std::filesystem::path> documents() {
  std::vector<std::filesystem::path> out;
  for (const auto& entry : std::filesystem::directory_iterator(kSource)) out.push_back(entry.path());
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "doc")) out.push_back(entry.path());
  std::erase_if(out, [](const auto& file) { return file.extension() != ".md"; });
  std::sort(out.begin(), out.end());
  return out;
}

/// Options of the tools that the documents mention: cmake, ctest, MRPT's rawlog-edit.
const std::set<std::string>& otherToolsOptions() {
  static const std::set<std::string> words = {"--preset", "--build", "--info"};
  return words;
}

TEST(Documents, EachOptionThatTheyNameExists) {
  std::set<std::string> known = otherToolsOptions();
  for (const auto& program : programs()) known.merge(optionsIn(wholeHelp(program)));
  for (const auto& file : documents())
    for (const auto& option : optionsIn(readFile(file)))
      EXPECT_EQ(known.count(option), 1u) << file << " names " << option << ", which no program has";
}

TEST(Documents, RelativeLinksLeadSomewhere) {
  static const std::regex link("\\]\\(([^)# ]+)[^)]*\\)");
  for (const auto& file : documents()) {
    const std::string text = readFile(file);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string target = (*it)[1];
      if (target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
      EXPECT_TRUE(std::filesystem::exists(file.parent_path() / target)) << file << " links to " << target;
    }
  }
}

TEST(Documents, EachProgramHasAManualPageWithAllItsOptions) {
  for (const auto& program : programs()) {
    const auto file = kSource / "doc" / "man" / (program + ".1");
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    std::string page = readFile(file);
    std::erase(page, '\\');
    const auto described = optionsIn(page), existing = optionsIn(wholeHelp(program));
    for (const auto& option : existing) EXPECT_EQ(described.count(option), 1u) << file << " lacks " << option;
    for (const auto& option : described) EXPECT_EQ(existing.count(option), 1u) << file << " invents " << option;
    for (const auto& sub : subcommandsIn(runShell(program + " --help").out))
      EXPECT_NE(page.find(sub), std::string::npos) << file << " lacks " << sub;
  }
}

TEST(Documents, EachProgramIsInTheListOfPrograms) {
  const std::string list = readFile(kSource / "doc" / "programs.md");
  for (const auto& program : programs()) EXPECT_NE(list.find("`" + program), std::string::npos) << program;
}

TEST(Documents, TheTableOfParametersIsThatOfTheCode) {
  LocalizeConfig config;
  PathConfig path;
  BandPlannerParams band;
  const std::string expected =
      "# Parameters\n\n"
      "All that a YAML for `sidestep-localize` may hold, with defaults. Generated from the code; do not edit. After a\n"
      "change of parameters:\n\n"
      "    SIDESTEP_REGENERATE=1 build/release/bin/test_contracts\n\n"
      "A dot separates a group from its key: `ekf.gate` is `gate` under `ekf:`. Whatever a file leaves out keeps its\n"
      "default. `sidestep-localize --write-config` prints the same as YAML.\n\n" +
      markdownTable([&](ParamVisitor& v) { config.visit(v); }) +
      "\n## sidestep-plan path\n\n`sidestep-plan path --write-config` prints them as YAML.\n\n" +
      markdownTable([&](ParamVisitor& v) { path.visit(v); }) +
      "\n## sidestep-plan band\n\n`sidestep-plan band --write-config` prints them as YAML, with the robot's.\n\n" +
      markdownTable([&](ParamVisitor& v) { v.section("planner", "", [&](ParamVisitor& s) { band.visit(s); }); });
  const auto file = kSource / "doc" / "parameters.md";
  if (std::getenv("SIDESTEP_REGENERATE") != nullptr) writeFile(file, expected);
  EXPECT_EQ(readFile(file), expected)
      << "out of date; SIDESTEP_REGENERATE=1 build/release/bin/test_contracts writes it";
}

}  // namespace
}  // namespace sidestep::testing
