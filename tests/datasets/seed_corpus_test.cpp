// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The logs under tests/data, which the fuzz program starts from. SIDESTEP_WRITE_CORPUS=1 writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "support/damaged_logs.h"

namespace sidestep {
namespace {

using namespace worlds;

const std::string kFolder = std::string(SIDESTEP_SOURCE) + "/tests/data/";

TEST(SeedCorpusTest, TheCommittedLogsAreWhatTheirDescriptionMakes) {
  TemporaryFolder folder;
  for (const auto& [name, bytes] : seedCorpus(folder)) {
    const std::string file = kFolder + name + ".rawlog";
    if (std::getenv("SIDESTEP_WRITE_CORPUS") != nullptr) store(file, bytes);
    EXPECT_TRUE(contents(file) == bytes) << name;
  }
}

TEST(SeedCorpusTest, EachIsWholeOrDamagedAsItsNameSays) {
  TemporaryFolder folder;
  const std::set<std::string> damaged{"cut-gzip", "cut-plain",       "flipped",       "empty",
                                      "text",     "gzip-of-nothing", "hostile-length"};
  LogReaderOptions options;
  options.memory_limit_bytes = 256u << 20;
  for (const auto& [name, bytes] : seedCorpus(folder)) {
    const ReadLog log = readLog(kFolder + name + ".rawlog", options);
    EXPECT_EQ(log.end.damaged, damaged.contains(name)) << name << ": " << log.end.message;
  }
}

}  // namespace
}  // namespace sidestep
