// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Every YAML that is installed loads with the program it belongs to.
#include <gtest/gtest.h>

#include <map>

#include "support/run_program.h"

namespace sidestep::testing {
namespace {

/// How the files of a folder of share/ are read.
const std::map<std::string, std::string>& readerOf() {
  static const std::map<std::string, std::string> table = {{"robots", "sidestep-localize -c"},
                                                          {"scenarios", "sidestep-simulate"},
                                                          {"studies", "sidestep-evaluate"}};
  return table;
}

TEST(Share, EachYamlLoadsAndWhatItMeansReadsBackIdentically) {
  const std::filesystem::path share = std::filesystem::path(SIDESTEP_SOURCE) / "share";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(share)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string kind = entry.path().lexically_relative(share).begin()->string();
    ASSERT_EQ(readerOf().count(kind), 1u) << "say in this test which program reads share/" << kind;
    const std::string program = readerOf().at(kind);
    const auto run = runShell(program + " '" + entry.path().string() + "' --write-config");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const TemporaryFolder folder;
    writeFile(folder / "all.yaml", run.out);
    EXPECT_EQ(runShell(program + " all.yaml --write-config", folder.path()).out, run.out) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace sidestep::testing
