// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// A name of code in backticks in doc/ exists: words with an underscore or a capital inside, and files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "evaluation/study/study_runner.h"
#include "support/run_program.h"

namespace sidestep::testing {
namespace {

const std::filesystem::path kSource(SIDESTEP_SOURCE);

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Pieces of `text` of characters for which `belongs` holds.
template <class Belongs>
std::vector<std::string> pieces(const std::string& text, Belongs belongs) {
  std::vector<std::string> out;
  for (size_t i = 0; i < text.size();) {
    size_t end = i;
    while (end < text.size() && belongs(text[end])) ++end;
    if (end > i) out.push_back(text.substr(i, end - i));
    i = std::max(end, i + 1);
  }
  return out;
}

/// All words and file names of the sources.
struct Names {
  std::set<std::string> words, files;

  /// @param in_part  a part of a word is enough, as in a filter of tests: `*MapsOf*`, `MapsOf...`
  bool hasWord(const std::string& word, bool in_part) const {
    if (words.count(word) > 0) return true;
    return in_part && std::any_of(words.begin(), words.end(), [&](const auto& w) { return w.find(word) != w.npos; });
  }
  void addText(const std::string& text) {
    for (auto& word : pieces(text, isWordCharacter)) words.insert(std::move(word));
    for (auto& name : pieces(text, [](char c) { return isWordCharacter(c) || c == '.' || c == '-'; }))
      if (name.find('.') != std::string::npos) files.insert(std::move(name));
  }
  void addFile(const std::filesystem::path& file) {
    files.insert(file.filename().string());
    const std::string stem = file.stem().string();
    if (stem.ends_with("_bench")) words.insert("bench_" + stem.substr(0, stem.size() - 6));
    if (file.extension() != ".rawlog" && file.filename() != "names_test.cpp") addText(readFile(file));
  }
};

Names namesOfTheSource() {
  Names out;
  for (const char* folder : {"libs", "apps", "tests", "share", "cmake", "rawlogs"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / folder)) {
      if (entry.is_directory()) out.words.insert("test_" + entry.path().filename().string());
      if (entry.is_regular_file()) out.addFile(entry.path());
    }
  for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "Makefile", "packages.txt"})
    out.addFile(kSource / file);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "doc"))
    out.files.insert(entry.path().filename().string());
  for (const auto& kind : studyKinds())  // some are put together from parts
    for (const auto& metric : makeStudyRunner(kind, "")->metrics()) out.words.insert(metric.name);
  return out;
}

/// Words that a reader fills in: NAME, SCENARIO.
bool isPlaceholder(const std::string& word) { return std::regex_search(word, std::regex("(^|[^A-Z_])[A-Z]{4,}$")); }

bool looksLikeCode(const std::string& word) {
  static const std::regex snake("[A-Za-z]\\w*_\\w+"), camel("\\w*[a-z][A-Z]\\w*");
  return std::regex_match(word, snake) || std::regex_match(word, camel);
}

/// What stands in backticks, outside of blocks of code.
std::vector<std::string> spansOf(const std::string& markdown) {
  std::vector<std::string> out;
  bool in_block = false;
  for (const auto& line : linesOf(markdown)) {
    if (line.starts_with("```")) in_block = !in_block;
    if (in_block) continue;
    static const std::regex span("`([^`]+)`");
    for (std::sregex_iterator it(line.begin(), line.end(), span), end; it != end; ++it) out.push_back((*it)[1]);
  }
  return out;
}

/// The names in a document that are not in the sources, a line each.
std::string unknownNames(const std::string& markdown, const Names& names) {
  static const std::regex file("[\\w-]+\\.(h|cpp|yaml|md|csv|png|json|tum|rawlog|txt|html|mp4|cmake)");
  std::string out;
  for (const auto& span : spansOf(markdown)) {
    const bool command = span.starts_with("sidestep-");  // its files are the user's
    const bool in_part = span.find('*') != span.npos || span.find("...") != span.npos;
    for (const auto& piece : pieces(span, [](char c) { return isWordCharacter(c) || c == '.' || c == '-'; })) {
      const std::string stem = piece.substr(0, piece.find('.'));
      if (std::regex_match(piece, file)) {
        if (!command && !isPlaceholder(stem) && names.files.count(piece) == 0) out += piece + "\n";
        continue;
      }
      for (const auto& word : pieces(piece, isWordCharacter))
        if (looksLikeCode(word) && !isPlaceholder(word) && !names.hasWord(word, in_part)) out += word + "\n";
    }
  }
  return out;
}

TEST(Documents, NamesInBackticksExist) {
  const Names names = namesOfTheSource();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "doc"))
    if (entry.path().extension() == ".md") {
      EXPECT_EQ(unknownNames(readFile(entry.path()), names), "") << entry.path();
    }
}

TEST(Documents, ANameThatDoesNotExistIsFound) {
  Names names;
  names.addText("class WorldRunner; int time_s; // see world.yaml\n");
  EXPECT_EQ(unknownNames("`WorldRunner::time_s` reads `share/world.yaml`, `NAME.yaml`; `sidestep-plan x_y.csv`\n"
                         "```\nold_name\n```\nnot code: old_name; `WorldRuner`, `times_s`, `worlds.yaml`, `plain`\n",
                         names),
            "WorldRuner\ntimes_s\nworlds.yaml\n");
}

}  // namespace
}  // namespace sidestep::testing
