// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Every YAML that is installed loads with the program it belongs to.
#include <gtest/gtest.h>

#include <map>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

/// The program that reads the files of a folder of share/.
const std::map<std::string, std::string>& readerOf() {
  static const std::map<std::string, std::string> table = {{"robots", "sidestep-localize"},
                                                           {"scenarios", "sidestep-simulate"}};
  return table;
}

TEST(Share, EachYamlLoadsAndWhatItMeansReadsBackIdentically) {
  const std::filesystem::path share = std::filesystem::path(SIDESTEP_SOURCE) / "share";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(share)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string kind = entry.path().lexically_relative(share).begin()->string();
    if (kind == "scripts") continue;  // below
    ASSERT_EQ(readerOf().count(kind), 1u) << "say in this test which program reads share/" << kind;
    const std::string program = readerOf().at(kind);
    const auto run = runShell(program + " -c '" + entry.path().string() + "' --write-config");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const TemporaryFolder folder;
    writeFile(folder / "all.yaml", run.out);
    EXPECT_EQ(runShell(program + " -c all.yaml --write-config", folder.path()).out, run.out) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST(Share, EachScriptLoads) {
  const std::filesystem::path scripts = std::filesystem::path(SIDESTEP_SOURCE) / "share" / "scripts";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scripts)) {
    const TemporaryFolder folder;
    const auto run = runShell("sidestep-rawlog degrade tests/data/whole-gzip.rawlog --script '" +
                              entry.path().string() + "' -o '" + (folder / "out.rawlog").string() + "'");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace sidestep::testing
