// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Modules include only what lies above them in the table of doc/design.md.
#include <gtest/gtest.h>

#include <map>

#include "support/source_files.h"

namespace sidestep::testing {
namespace {

using Modules = std::set<std::string>;

const std::map<std::string, Modules>& mayInclude() {
  static const std::map<std::string, Modules> table = {
      {"core", {}},
      {"datasets", {"core"}},
      {"maps", {"core"}},
      {"control", {"core"}},
      {"figures", {"core", "maps"}},
      {"localization", {"core", "maps"}},
      {"perception", {"core", "maps"}},
      {"planning", {"core", "maps"}},
      {"simulation", {"core", "maps", "control"}},
      {"robots", {"core", "control"}},
      {"navigation", {"core", "datasets", "maps", "localization", "perception", "planning", "control"}},
      {"live", {"core", "datasets", "navigation"}},
      {"evaluation",
       {"core", "datasets", "maps", "figures", "localization", "perception", "planning", "control", "simulation",
        "navigation"}}};
  return table;
}

/// What is wrong with the includes of one file of `module`, a line each.
std::string complaints(const std::string& module, const std::string& file, const std::string& text) {
  static const std::regex include("^\\s*#\\s*include\\s*[\"<]([^\">]+)[\">].*$");
  const auto row = mayInclude().find(module);
  if (row == mayInclude().end()) return file + ": no module '" + module + "' in the table\n";
  std::string out;
  int number = 0;
  for (const auto& line : linesOf(text)) {
    ++number;
    std::smatch match;
    if (!std::regex_match(line, match, include)) continue;
    const std::string target = match[1], first = target.substr(0, target.find('/'));
    const bool ours = mayInclude().count(first) > 0 || target.starts_with("..") || first == "common" || first == "apps";
    if (ours && first != module && row->second.count(first) == 0)
      out += file + ":" + std::to_string(number) + ": " + module + " may not include " + target + "\n";
  }
  return out;
}

TEST(IncludeDirection, IsThatOfTheDesign) {
  const std::filesystem::path libs = std::filesystem::path(SIDESTEP_SOURCE) / "libs";
  std::string all;
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(libs)) {
    const auto extension = entry.path().extension();
    if (extension != ".h" && extension != ".cpp") continue;
    const auto relative = entry.path().lexically_relative(libs);
    all += complaints(relative.begin()->string(), relative.string(), readFile(entry.path()));
    ++files;
  }
  EXPECT_EQ(all, "");
  EXPECT_GT(files, 20);
}

TEST(IncludeDirection, AnArrowDownTheTableIsFound) {
  EXPECT_EQ(complaints("core", "core/a.h", "#include \"core/b.h\"\n#include \"datasets/log_reader.h\"\n"),
            "core/a.h:2: core may not include datasets/log_reader.h\n");
  EXPECT_NE(complaints("localization", "localization/a.cpp", "  # include <datasets/log_reader.h>\n"), "");
  EXPECT_NE(complaints("datasets", "datasets/a.cpp", "#include \"../localization/ekf.h\"\n"), "");
  EXPECT_NE(complaints("evaluation", "evaluation/a.cpp", "#include \"common/program.h\"\n"), "");
  EXPECT_NE(complaints("helpers", "helpers/a.cpp", ""), "");
}

TEST(IncludeDirection, OwnModuleModulesAboveAndOthersLibrariesAreAllowed) {
  EXPECT_EQ(complaints("localization", "localization/a.cpp",
                       "#include \"localization/filters/ekf.h\"\n#include \"core/params.h\"\n#include <vector>\n"
                       "#include <mrpt/maps/COccupancyGridMap2D.h>\n// #include \"datasets/x.h\"\n"),
            "");
}

using Includes = std::map<std::string, std::vector<std::string>>;

/// Which file of ours includes which others of ours.
Includes includesOf(const std::map<std::string, std::string>& files) {
  static const std::regex include("(^|\n)[ \t]*#[ \t]*include[ \t]*\"([^\"\n]+)\"");
  Includes out;
  for (const auto& [file, text] : files)
    for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it)
      if (files.count((*it)[2]) > 0) out[file].push_back((*it)[2]);
  return out;
}

/// The files of a circle that can be reached from `file`, "" if there is none. @param done  files that are in no circle
std::string circleFrom(const std::string& file, const Includes& includes, std::vector<std::string>& path,
                       std::set<std::string>& done) {
  if (done.count(file) > 0) return "";
  const auto seen = std::find(path.begin(), path.end(), file);
  if (seen != path.end()) {
    std::string out;
    for (auto it = seen; it != path.end(); ++it) out += *it + " -> ";
    return out + file;
  }
  path.push_back(file);
  if (const auto row = includes.find(file); row != includes.end())
    for (const auto& next : row->second)
      if (auto circle = circleFrom(next, includes, path, done); !circle.empty()) return circle;
  path.pop_back();
  done.insert(file);
  return "";
}

std::string firstCircle(const Includes& includes) {
  std::set<std::string> done;
  for (const auto& [file, targets] : includes) {
    std::vector<std::string> path;
    if (auto circle = circleFrom(file, includes, path, done); !circle.empty()) return circle;
  }
  return "";
}

TEST(IncludeDirection, NoFilesIncludeEachOtherInACircle) {
  const auto includes = includesOf(sourceFiles());
  EXPECT_EQ(firstCircle(includes), "");
  EXPECT_GT(includes.size(), 100u);
}

TEST(IncludeDirection, ACircleIsFound) {
  EXPECT_EQ(firstCircle(includesOf({{"m/a.h", "#include \"m/b.h\"\n#include <vector>\n"},
                                    {"m/b.h", "#pragma once\n#include \"m/c.h\"\n"},
                                    {"m/c.h", "#include \"m/b.h\"\n"}})),
            "m/b.h -> m/c.h -> m/b.h");
}

}  // namespace
}  // namespace sidestep::testing
