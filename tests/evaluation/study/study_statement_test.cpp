// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_statement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.h"

namespace sidestep {
namespace {

std::string errorOf(const std::string& text) {
  try {
    parseStatement(text, "study.yaml: expect");
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

TEST(StudyStatement, IsFiveWords) {
  const auto s = parseStatement("circle-* enc+gps mean_error_m.ci_high <= 0.25", "");
  EXPECT_EQ(s.scenario, "circle-*");
  EXPECT_EQ(s.algorithm, "enc+gps");
  EXPECT_EQ(s.metric, "mean_error_m");
  EXPECT_EQ(s.statistic, "ci_high");
  EXPECT_EQ(s.comparison, "<=");
  EXPECT_EQ(s.value, 0.25);
  EXPECT_EQ(parseStatement("a b c = 1", "").statistic, "mean");
}

TEST(StudyStatement, HoldsAsItsComparisonSays) {
  EXPECT_TRUE(parseStatement("a b c <= 1", "").holds(1));
  EXPECT_FALSE(parseStatement("a b c < 1", "").holds(1));
  EXPECT_TRUE(parseStatement("a b c >= 1", "").holds(1));
  EXPECT_FALSE(parseStatement("a b c > 1", "").holds(1));
  EXPECT_TRUE(parseStatement("a b c = 1", "").holds(1));
  for (const char* op : {"<=", "<", ">=", ">", "="})
    EXPECT_FALSE(parseStatement(std::string("a b c ") + op + " 1", "").holds(NAN)) << op;
}

TEST(StudyStatement, AStarStandsForAnyCharacters) {
  EXPECT_TRUE(matchesPattern("*", ""));
  EXPECT_TRUE(matchesPattern("circle-*", "circle-10hz"));
  EXPECT_TRUE(matchesPattern("*-10hz", "circle-10hz"));
  EXPECT_TRUE(matchesPattern("c*e*z", "circle-10hz"));
  EXPECT_FALSE(matchesPattern("circle-*", "sinusoid-10hz"));
  EXPECT_FALSE(matchesPattern("circle", "circle-10hz"));
  EXPECT_FALSE(matchesPattern("circle-10hz*x", "circle"));
}

TEST(StudyStatement, AnErrorSaysWhatIsWrongAndHowToWriteIt) {
  EXPECT_EQ(
      errorOf("a b c <="),
      "study.yaml: expect 'a b c <=': is not five words; write it as SCENARIO ALGORITHM METRIC <= NUMBER (or =, >=, "
      "<, >)");
  EXPECT_NE(errorOf("a b c =< 1").find("'=<' is no comparison"), std::string::npos);
  EXPECT_NE(errorOf("a b c <= one").find("'one' is not a number"), std::string::npos);
  EXPECT_NE(errorOf("a b c <= nan").find("'nan' is not a number"), std::string::npos);
  EXPECT_NE(errorOf("a b c.ci_hihg <= 1").find("did you mean 'ci_high'?"), std::string::npos);
}

}  // namespace
}  // namespace sidestep
