// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// The program as a user runs it.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "support/log_worlds.h"

namespace sidestep {
namespace {

using namespace worlds;

struct Outcome {
  int code = 0;
  std::string text;
};

class SidestepRawlogTest : public testing::Test {
 protected:
  Outcome run(const std::string& arguments, const std::string& streams = "2>&1") {
    const std::string command = std::string(SIDESTEP_BIN) + "/sidestep-rawlog " + arguments + " " + streams;
    FILE* pipe = popen(command.c_str(), "r");
    Outcome out;
    std::array<char, 4096> chunk;
    while (const size_t n = fread(chunk.data(), 1, chunk.size(), pipe)) out.text.append(chunk.data(), n);
    const int status = pclose(pipe);
    out.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return out;
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "log.rawlog";
};

TEST_F(SidestepRawlogTest, AWholeLogIsHealthyAndTheExitCodeIsZero) {
  writeLog(log_);
  const Outcome check = run("check " + log_);
  EXPECT_EQ(check.code, 0);
  EXPECT_EQ(check.text, log_ + ": healthy\n");
}

TEST_F(SidestepRawlogTest, InfoAsJsonCanBeParsed) {
  writeLog(log_, 20);
  const Outcome info = run("info " + log_ + " --json", "2>/dev/null");
  const auto json = nlohmann::json::parse(info.text);
  EXPECT_EQ(json["verdict"], "healthy");
  EXPECT_EQ(json["labels"]["gps"]["count"], 20);
}

TEST_F(SidestepRawlogTest, ACutLogGivesFourAndCanBeRecovered) {
  writeLog(log_, 50);
  const std::string whole = contents(log_);
  store(log_, whole.substr(0, whole.size() / 2));
  EXPECT_EQ(run("check " + log_).code, 4);
  const std::string saved = folder_ / "saved.rawlog";
  EXPECT_EQ(run("recover " + log_ + " -o " + saved).code, 0);
  EXPECT_EQ(run("check " + saved).code, 0);
}

TEST_F(SidestepRawlogTest, RecoverWritesOverNothingUnlessToldTo) {
  writeLog(log_);
  store(folder_ / "there", "mine");
  EXPECT_EQ(run("recover " + log_ + " -o " + (folder_ / "there")).code, 2);
  EXPECT_EQ(contents(folder_ / "there"), "mine");
  EXPECT_EQ(run("recover " + log_ + " -w -o " + (folder_ / "there")).code, 0);
  EXPECT_EQ(run("recover " + log_ + " -w -o " + log_).code, 2);
}

TEST_F(SidestepRawlogTest, AMissingLogGivesThreeAndOneLine) {
  const Outcome check = run("check /nonexistent.rawlog");
  EXPECT_EQ(check.code, 3);
  EXPECT_EQ(check.text, "sidestep-rawlog: error: /nonexistent.rawlog: cannot be opened: No such file or directory\n");
}

TEST_F(SidestepRawlogTest, AMisspeltOptionGivesTwoAndTheNearest) {
  const Outcome check = run("check " + log_ + " --jsno");
  EXPECT_EQ(check.code, 2);
  EXPECT_NE(check.text.find("did you mean --json?"), std::string::npos) << check.text;
}

TEST_F(SidestepRawlogTest, EachHelpEndsWithAnExampleThatRuns) {
  for (const std::string command : {"", "info", "check", "recover"}) {
    const std::string help = run(command + " --help").text;
    const std::string key = "\n  sidestep-rawlog ";
    ASSERT_NE(help.rfind(key), std::string::npos) << command;
    std::string example = help.substr(help.rfind(key) + key.size());
    example.erase(example.find('\n'));
    if (command == "recover") example.replace(example.find("recovered.rawlog"), 16, folder_ / "recovered.rawlog");
    EXPECT_EQ(run(example).code, 0) << example;
  }
}

TEST_F(SidestepRawlogTest, LabelsCannotSteerTheTerminal) {
  auto evil = odometry(kStart_s);
  evil.sensorLabel = "\x1b[2Jgone";
  store(log_, plainLog(evil));
  EXPECT_EQ(run("info " + log_).text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace sidestep
