// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "datasets/ground_truth.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

constexpr double kPi = std::numbers::pi;

/// A file with this content as long as the test runs.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content = "") {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    name_ = testing::TempDir() + "/" + test->name() + std::to_string(getpid()) + ".txt";
    std::ofstream(name_) << content;
  }
  ~TemporaryFile() { std::remove(name_.c_str()); }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

/// What reading this content complains about, without the file's name.
std::string complaint(const std::string& content) {
  const TemporaryFile file(content);
  try {
    GroundTruth::fromFile(file.name());
  } catch (const DatasetError& error) {
    EXPECT_EQ(error.code(), ExitCode::kInputCorrupt);
    return std::string(error.what()).substr(file.name().size());
  }
  return "nothing";
}

TEST(GroundTruth, InterpolatesAlongTheShorterTurn) {
  GroundTruth truth;
  truth.push({10, {0, 0, kPi - 0.1}, true});
  truth.push({11, {4, 8, -kPi + 0.3}, true});
  const auto pose = truth.at(10.25);  // a quarter of the way: turn 0.4 / 4 from pi - 0.1 is just pi
  ASSERT_TRUE(pose);
  EXPECT_NEAR(pose->pose.x, 1, 1e-12);
  EXPECT_NEAR(pose->pose.y, 2, 1e-12);
  EXPECT_NEAR(std::abs(pose->pose.phi), kPi, 1e-12);
  EXPECT_EQ(pose->time_s, 10.25);
}

TEST(GroundTruth, IsUnknownOutsideAndInGaps) {
  GroundTruth truth(1.5);
  for (const double t : {1.0, 2.0, 4.0, 5.0}) truth.push({t, {t, 0, 0}, true});
  EXPECT_FALSE(truth.at(0.5));
  EXPECT_TRUE(truth.at(1.5));
  EXPECT_TRUE(truth.at(2));
  EXPECT_FALSE(truth.at(3));
  EXPECT_TRUE(truth.at(4));  // exactly at a stamp a gap does not matter
  EXPECT_EQ(truth.at(5)->pose.x, 5);
  EXPECT_FALSE(truth.at(5.1));
  EXPECT_FALSE(truth.at(std::nan("")));
}

TEST(GroundTruth, LeavesOutPosesThatAreNotFiniteOrGoBackwards) {
  GroundTruth truth;
  EXPECT_TRUE(truth.push({2, {}, true}));
  EXPECT_FALSE(truth.push({1, {}, true}));
  EXPECT_FALSE(truth.push({3, {std::nan(""), 0, 0}, true}));
}

TEST(GroundTruth, HasNoHeadingBetweenPosesWithoutHeading) {
  GroundTruth truth;
  truth.push({1, {}, false});
  truth.push({2, {}, true});
  EXPECT_FALSE(truth.at(1.5)->has_heading);
  EXPECT_TRUE(truth.at(2)->has_heading);
}

TEST(GroundTruth, ReadsTum) {
  // Half turn about z: q = (0, 0, sin 45 deg, cos 45 deg) is a yaw of 90 deg.
  const TemporaryFile file("# t x y z\n1 2 3 0 0 0 0 1\n\n2 4 5 0 0 0 0.70710678118654757 0.70710678118654757\r\n");
  const auto truth = GroundTruth::fromFile(file.name());
  EXPECT_FALSE(truth->isRowIndexed());
  EXPECT_NEAR(truth->at(1.5)->pose.phi, kPi / 4, 1e-12);
  EXPECT_EQ(truth->at(2)->pose.x, 4);
  EXPECT_TRUE(truth->at(2)->has_heading);
  EXPECT_FALSE(truth->row(0));
}

TEST(GroundTruth, ReadsCommasAndPercentComments) {
  const TemporaryFile file("% t, x, y, yaw\n1.5, 2, 3, 0.25\n2.5,4,5,+0.75\n");
  const auto truth = GroundTruth::fromFile(file.name());
  EXPECT_NEAR(truth->at(2)->pose.phi, 0.5, 1e-12);
}

TEST(GroundTruth, SeesThatIdentityQuaternionsOfARobotThatTurnedAreNoHeading) {
  const TemporaryFile file("1 0 0 0 0 0 0 1\n2 1 0.5 0 0 0 0 1\n");
  EXPECT_FALSE(GroundTruth::fromFile(file.name())->at(1.5)->has_heading);
}

TEST(GroundTruth, BelievesIdentityQuaternionsOfARobotThatRunsAlongX) {
  const TemporaryFile file("1 0 0 0 0 0 0 1\n2 1 0.01 0 0 0 0 1\n");
  EXPECT_TRUE(GroundTruth::fromFile(file.name())->at(1.5)->has_heading);
}

TEST(GroundTruth, ReadsRowIndexedFiles) {
  const TemporaryFile file("0 0 0 0\n1 0.5 0 0\n2 1 0 0.1\n3 1.5 0 0.2\n");
  const auto truth = GroundTruth::fromFile(file.name());
  EXPECT_TRUE(truth->isRowIndexed());
  EXPECT_EQ(truth->row(0)->pose.x, 0);
  EXPECT_EQ(truth->row(2)->pose.x, 1);
  EXPECT_EQ(truth->row(2)->pose.x, 1);
  EXPECT_EQ(truth->row(3)->pose.phi, 0.2);
  EXPECT_FALSE(truth->row(4));
  EXPECT_FALSE(truth->at(1));
}

TEST(GroundTruth, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint("1 2 3\n"), ":1: 3 numbers, expected 8 (t x y z qx qy qz qw) or 4 (t x y yaw)");
  EXPECT_EQ(complaint("#\n1 2 3 0\n2 2 3\n"), ":3: 3 numbers, expected 4 as in the lines before");
  EXPECT_EQ(complaint("1 2 3 0 0 0 0 1\n2 2 3 0 0 0 0 1 9\n"), ":2: 9 numbers, expected 8 as in the lines before");
  EXPECT_EQ(complaint("1 2 x3 0\n"), ":1: 'x3' is not a number");
  EXPECT_EQ(complaint("1 2 nan 0\n"), ":1: 'nan' is not finite");
  EXPECT_EQ(complaint("1 2 3 0 0 0 0 0\n"), ":1: quaternion of length 0, expected 1");
  EXPECT_EQ(complaint("1 2 3 0 0 0 0 nan\n"), ":1: 'nan' is not finite");
  EXPECT_EQ(complaint("1.5 2 3 0\n1.25 2 3 0\n"), ":2: time goes backwards, from 1.5 to 1.25");
  EXPECT_EQ(complaint("# nothing\n"), ": holds no poses");
}

TEST(GroundTruth, SaysThatAFileIsMissing) {
  try {
    GroundTruth::fromFile("/nowhere/gt.tum");
    FAIL();
  } catch (const DatasetError& error) {
    EXPECT_EQ(error.code(), ExitCode::kInputMissing);
    EXPECT_STREQ(error.what(), "/nowhere/gt.tum: cannot be read: No such file or directory");
  }
}

TEST(TumWriter, WritesWhatReadsBackTheSame) {
  const TemporaryFile file;
  TumWriter writer(file.name());
  writer.write(1.5, {0.1, -2, 0});
  writer.write(1700000000.25, {1e6, 1.0 / 3, 1});
  writer.close();
  std::ostringstream text;
  text << std::ifstream(file.name()).rdbuf();
  EXPECT_EQ(text.str().substr(0, text.str().find('\n')), "1.500000000 0.1 -2 0 0 0 0 1");
  const auto pose = GroundTruth::fromFile(file.name())->at(1700000000.25);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->pose.y, 1.0 / 3);
  EXPECT_NEAR(pose->pose.phi, 1, 1e-15);
}

TEST(TumWriter, NoticesAFullDisk) {
  TumWriter writer("/dev/full");
  writer.write(1, {});
  EXPECT_THROW(writer.close(), DatasetError);
}

TEST(TumWriter, NoticesAPlaceWhereItCannotWrite) { EXPECT_THROW(TumWriter("/nowhere/x.tum"), DatasetError); }

}  // namespace
}  // namespace sidestep
