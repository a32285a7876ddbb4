// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/params.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>

#include "core/errors.h"

namespace sidestep {
namespace {

/// One field of each kind.
struct Sample {
  double speed_m_s = 1.5;
  double yaw = 0.25;  // rad
  double anything = 0;
  int count = 3;
  bool enabled = true;
  std::string mode = "auto";
  std::string label = "GPS";
  std::vector<std::string> labels = {"a", "b"};
  Table corners = {{1, 0.5}};
  double inner_sd_m = 0.1;

  void visit(ParamVisitor& v) {
    v.number("speed_m_s", speed_m_s, {0, 10}, "m/s", "how fast");
    v.angle("yaw_deg", yaw, {-180, 180}, "where to");
    v.number("anything", anything, {}, "", "no bounds");
    v.integer("count", count, {1, 9}, "how many");
    v.flag("enabled", enabled, "whether at all");
    v.choice("mode", mode, {"auto", "on", "off"}, "which way");
    v.text("label", label, "whose");
    v.texts("labels", labels, "whose all");
    v.table("corners", {"x", "turn_deg"}, corners, "where and how");
    v.section("inner", "a group", [this](ParamVisitor& w) { w.number("sd_m", inner_sd_m, {0.01}, "m", "spread"); });
  }
  Visit fields() {
    return [this](ParamVisitor& v) { visit(v); };
  }
};

std::string errorOf(const std::string& yaml) {
  Sample s;
  try {
    readYamlText(yaml, "robot.yaml", s.fields());
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.code(), ExitCode::kUsage);
    return e.what();
  }
  return "no error";
}

TEST(Params, SaysFileLineKeyValueUnitAndRangeOfAValueOutOfRange) {
  EXPECT_EQ(errorOf("count: 2\nspeed_m_s: 11\n"), "robot.yaml:2: speed_m_s = 11 m/s, allowed 0 .. 10");
  EXPECT_EQ(errorOf("speed_m_s: -0.001"), "robot.yaml:1: speed_m_s = -0.001 m/s, allowed 0 .. 10");
  EXPECT_EQ(errorOf("yaw_deg: 181"), "robot.yaml:1: yaw_deg = 181 deg, allowed -180 .. 180");
  EXPECT_EQ(errorOf("count: 0"), "robot.yaml:1: count = 0, allowed 1 .. 9");
}

TEST(Params, SaysARangeWithOneEndAndTheGroupOfTheKey) {
  EXPECT_EQ(errorOf("inner:\n  sd_m: 0"), "robot.yaml:2: inner.sd_m = 0 m, allowed >= 0.01");
}

TEST(Params, AllowsBothEndsOfARange) {
  Sample s;
  readYamlText("speed_m_s: 10\ncount: 1", "robot.yaml", s.fields());
  EXPECT_EQ(s.speed_m_s, 10);
  EXPECT_EQ(s.count, 1);
}

TEST(Params, SaysTheNearestKnownKeyForAnUnknownOne) {
  EXPECT_EQ(errorOf("\nsped_m_s: 1"), "robot.yaml:2: sped_m_s is no known key; did you mean 'speed_m_s'?");
  EXPECT_EQ(errorOf("inner: {sd: 1}"), "robot.yaml:1: inner.sd is no known key; did you mean 'sd_m'?");
  EXPECT_EQ(errorOf("xyzzyplugh: 1"), "robot.yaml:1: xyzzyplugh is no known key");
}

TEST(Params, RefusesARepeatedKey) {
  EXPECT_EQ(errorOf("count: 2\ncount: 3"), "robot.yaml:2: count is given twice");
  EXPECT_EQ(errorOf("inner:\n  sd_m: 1\n  sd_m: 1"), "robot.yaml:3: inner.sd_m is given twice");
}

TEST(Params, RefusesAValueOfTheWrongType) {
  EXPECT_EQ(errorOf("speed_m_s: fast"), "robot.yaml:1: speed_m_s = fast is not a number");
  EXPECT_EQ(errorOf("speed_m_s: 1.5 m/s"), "robot.yaml:1: speed_m_s = 1.5 m/s is not a number");
  EXPECT_EQ(errorOf("speed_m_s:"), "robot.yaml:1: speed_m_s = nothing is not a number");
  EXPECT_EQ(errorOf("speed_m_s: [1]"), "robot.yaml:1: speed_m_s = a list is not a number");
  EXPECT_EQ(errorOf("speed_m_s: {a: 1}"), "robot.yaml:1: speed_m_s = a map is not a number");
  EXPECT_EQ(errorOf("enabled: yes"), "robot.yaml:1: enabled = yes, allowed true, false");
  EXPECT_EQ(errorOf("label: [a]"), "robot.yaml:1: label is not a text");
  EXPECT_EQ(errorOf("labels: a"), "robot.yaml:1: labels is not a list");
  EXPECT_EQ(errorOf("labels: [[a]]"), "robot.yaml:1: labels holds something that is not a text");
  EXPECT_EQ(errorOf("inner: 3"), "robot.yaml:1: inner is not a map of keys");
  EXPECT_EQ(errorOf("- 1"), "robot.yaml:1: the file is not a map of keys");
}

TEST(Params, RefusesNumbersThatAreNotFinite) {
  EXPECT_EQ(errorOf("anything: nan"), "robot.yaml:1: anything = nan is not finite");
  EXPECT_EQ(errorOf("anything: inf"), "robot.yaml:1: anything = inf is not finite");
  EXPECT_EQ(errorOf("anything: -inf"), "robot.yaml:1: anything = -inf is not finite");
  EXPECT_EQ(errorOf("anything: .nan"), "robot.yaml:1: anything = .nan is not a number");
  EXPECT_EQ(errorOf("anything: 1e999"), "robot.yaml:1: anything = 1e999 is not a number");
}

TEST(Params, RefusesAnIntegerWithAFraction) {
  EXPECT_EQ(errorOf("count: 2.5"), "robot.yaml:1: count = 2.5 is not an integer");
}

TEST(Params, RefusesAWordThatIsNoChoice) {
  EXPECT_EQ(errorOf("mode: atuo"), "robot.yaml:1: mode = atuo, allowed auto, on, off; did you mean 'auto'?");
  EXPECT_EQ(errorOf("mode: [on]").substr(0, 50), "robot.yaml:1: mode = a list, allowed auto, on, off");
}

TEST(Params, SaysWhichRowAndColumnOfATableIsWrong) {
  EXPECT_EQ(errorOf("corners:\n- {x: 1, turn_deg: 2}\n- {x: 1}"), "robot.yaml:3: corners[1].turn_deg is missing");
  EXPECT_EQ(errorOf("corners:\n- {x: 1, turn_deg: 2, z: 3}").substr(0, 45),
            "robot.yaml:2: corners[0].z is no known key; d");
  EXPECT_EQ(errorOf("corners: [{x: a, turn_deg: 2}]"), "robot.yaml:1: corners[0].x = a is not a number");
  EXPECT_EQ(errorOf("corners: 3"), "robot.yaml:1: corners is not a list of rows");
}

TEST(Params, SaysWhereTextIsNotYaml) {
  EXPECT_EQ(errorOf("count: 2\nlabels: [a\n").substr(0, 24), "robot.yaml:3: not YAML: ");
  EXPECT_EQ(errorOf("count: \"2\n").substr(0, 11), "robot.yaml:");
}

TEST(Params, RefusesAKeyThatIsNoWord) {
  EXPECT_EQ(errorOf("count: 2\n? [a, b]\n: 3"), "robot.yaml:2: the file has a key that is not a word");
}

TEST(Params, NamesTheMissingFileAndHasItsOwnExitCode) {
  Sample s;
  try {
    readYaml("/nowhere/robot.yaml", s.fields());
    FAIL() << "no error";
  } catch (const DatasetError& e) {
    EXPECT_EQ(e.code(), ExitCode::kInputMissing);
    EXPECT_EQ(static_cast<int>(e.code()), 3);
    EXPECT_STREQ(e.what(), "/nowhere/robot.yaml: cannot be read as a configuration file; check the path");
  }
}

TEST(Params, DoesNotTakeAFolderForAnEmptyFile) {
  Sample s;
  EXPECT_THROW(readYaml(std::filesystem::temp_directory_path().string(), s.fields()), DatasetError);
}

TEST(Params, LeavesDefaultsWhereTheFileIsSilent) {
  Sample s;
  s.yaw = 0.1 + 0.2;  // no round number of degrees
  const double yaw = s.yaw;
  readYamlText("", "robot.yaml", s.fields());
  readYamlText("count: 4", "robot.yaml", s.fields());
  EXPECT_EQ(s.yaw, yaw);
  EXPECT_EQ(s.count, 4);
  EXPECT_EQ(s.inner_sd_m, 0.1);
  EXPECT_EQ(s.corners, (Table{{1, 0.5}}));
}

TEST(Params, ReadsDegreesIntoRadians) {
  Sample s;
  readYamlText("yaw_deg: 90\ncorners: [{x: 2, turn_deg: -180}]", "robot.yaml", s.fields());
  EXPECT_DOUBLE_EQ(s.yaw, M_PI / 2);
  EXPECT_DOUBLE_EQ(s.corners[0][1], -M_PI);
}

TEST(Params, ReadsBackWhatItHasWritten) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 200; ++i) {
    Sample a;
    a.speed_m_s = 5 + 5 * unit(random);
    a.yaw = 3 * unit(random);
    a.anything = std::ldexp(unit(random), i * 10 - 1000);
    a.count = 1 + i % 9;
    a.enabled = i % 2;
    a.mode = i % 2 ? "off" : "on";
    a.label = "a \"quoted\" \\ label: # with\nall\tof it";
    a.labels = {"", "x, y", "[z]"};
    a.corners = {{unit(random), unit(random)}, {1e300, -3}};
    Sample b;
    readYamlText(writeYaml(a.fields()), "robot.yaml", b.fields());
    EXPECT_EQ(b.speed_m_s, a.speed_m_s);
    EXPECT_NEAR(b.yaw, a.yaw, 1e-15 * std::abs(a.yaw));  // degrees and back: one rounding each way
    EXPECT_EQ(b.anything, a.anything);
    EXPECT_EQ(b.count, a.count);
    EXPECT_EQ(b.enabled, a.enabled);
    EXPECT_EQ(b.mode, a.mode);
    EXPECT_EQ(b.label, a.label);
    EXPECT_EQ(b.labels, a.labels);
    ASSERT_EQ(b.corners.size(), 2u);
    EXPECT_EQ(b.corners[0][0], a.corners[0][0]);
    EXPECT_NEAR(b.corners[0][1], a.corners[0][1], 1e-15 * std::abs(a.corners[0][1]));
    EXPECT_EQ(b.corners[1][0], 1e300);
  }
}

TEST(Params, WritesEachKeyWithMeaningUnitAndRange) {
  Sample s;
  const std::string yaml = writeYaml(s.fields());
  EXPECT_NE(yaml.find("speed_m_s: 1.5  # how fast [m/s]; 0 .. 10\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("count: 3  # how many; 1 .. 9\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("mode: auto  # which way; auto | on | off\n"), std::string::npos) << yaml;
  EXPECT_NE(yaml.find("# a group\ninner:\n  sd_m: 0.1  # spread [m]; >= 0.01\n"), std::string::npos) << yaml;
}

TEST(Params, ListsEachKeyInTheMarkdownTable) {
  Sample s;
  const std::string table = markdownTable(s.fields());
  for (const char* key :
       {"speed_m_s", "yaw_deg", "anything", "count", "enabled", "mode", "label", "labels", "corners", "inner.sd_m"})
    EXPECT_NE(table.find("| `" + std::string(key) + "` |"), std::string::npos) << key;
  EXPECT_NE(table.find("| `speed_m_s` | 1.5 | m/s | 0 .. 10 | how fast |\n"), std::string::npos) << table;
}

TEST(NearestWord, FindsATypoAndNothingThatIsFar) {
  EXPECT_EQ(nearestWord("headng", {"heading", "yaw_rate"}), "heading");
  EXPECT_EQ(nearestWord("yawrate", {"heading", "yaw_rate"}), "yaw_rate");
  EXPECT_EQ(nearestWord("qqqq", {"heading", "yaw_rate"}), "");
  EXPECT_EQ(nearestWord("x", {}), "");
}

TEST(ShortestNumber, ReadsBackToTheSameBits) {
  EXPECT_EQ(shortestNumber(0.1), "0.1");
  EXPECT_EQ(shortestNumber(3), "3");
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double value = std::ldexp(unit(random), i - 500);
    EXPECT_EQ(std::strtod(shortestNumber(value).c_str(), nullptr), value);
  }
}

/// Names that the file's author chooses, each with a field and an overlay.
struct Named {
  std::vector<std::string> names;
  std::map<std::string, double> values;
  std::map<std::string, std::string> overlays;

  Visit fields() {
    return [this](ParamVisitor& v) {
      v.groups("things", names, "by name", [this](const std::string& name, ParamVisitor& w) {
        w.number("size_m", values[name], {0, 10}, "m", "how large");
        w.overlay("set", overlays[name], "what is changed");
      });
    };
  }
};

TEST(Params, GroupsByNameKeepTheFilesOrderAndReadBack) {
  Named a, b;
  readYamlText("things:\n  zebra: {size_m: 2}\n  ant: {set: {inner: {sd_m: 0.5}, count: 2}}\n", "f.yaml", a.fields());
  EXPECT_EQ(a.names, (std::vector<std::string>{"zebra", "ant"}));
  EXPECT_EQ(a.values["zebra"], 2);
  const std::string text = writeYaml(a.fields());
  readYamlText(text, "g.yaml", b.fields());
  EXPECT_EQ(writeYaml(b.fields()), text);
  EXPECT_EQ(b.overlays["zebra"], "");
}

TEST(Params, AnErrorInAGroupOrAnOverlayNamesItsLine) {
  const auto errorIn = [](const std::string& text) -> std::string {
    Named n;
    Sample s;
    try {
      readYamlText(text, "f.yaml", n.fields());
      for (const auto& [name, yaml] : n.overlays) readYamlText(yaml, "f.yaml", s.fields());
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(errorIn("things:\n  ant:\n    size_m: 11\n"), "f.yaml:3: things.ant.size_m = 11 m, allowed 0 .. 10");
  EXPECT_EQ(errorIn("things:\n  ant:\n    set:\n      enabled: true\n      count: 10\n"),
            "f.yaml:5: count = 10, allowed 1 .. 9");
  EXPECT_EQ(errorIn("things:\n  ant: {set: 3}\n"), "f.yaml:2: things.ant.set is not a map of keys");
}

}  // namespace
}  // namespace sidestep
