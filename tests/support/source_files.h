// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Our sources as text, for the contracts that read them.
#pragma once
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <string>

#include "support/run_program.h"

namespace sidestep::testing {

/// All headers and sources of libs/ and apps/: path as an include names it -> text.
inline std::map<std::string, std::string> sourceFiles() {
  std::map<std::string, std::string> out;
  for (const char* top : {"libs", "apps"}) {
    const auto folder = std::filesystem::path(SIDESTEP_SOURCE) / top;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const auto extension = entry.path().extension();
      if (extension == ".h" || extension == ".cpp")
        out[entry.path().lexically_relative(folder).string()] = readFile(entry.path());
    }
  }
  return out;
}

/// A text of C++ in two: where one of them has a character, the other has a blank. Lines stay where they are.
struct CodeAndComments {
  std::string code, comments;  ///< strings and character constants are blanks in both
};

/// Where the comment, string or character constant ends that begins at `i`; `i` itself if none does.
inline size_t endOfPart(const std::string& text, size_t i) {
  const auto after = [&](const std::string& what, size_t from) {
    const size_t at = text.find(what, from);
    return at == std::string::npos ? text.size() : at + what.size();
  };
  if (text.compare(i, 2, "//") == 0) return std::min(text.find('\n', i), text.size());
  if (text.compare(i, 2, "/*") == 0) return after("*/", i + 2);
  if (text.compare(i, 2, "R\"") == 0) {
    const size_t open = text.find('(', i);
    return after(")" + text.substr(i + 2, open - i - 2) + "\"", open);
  }
  const bool digits = i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0;  // 1'000
  if (text[i] != '"' && (text[i] != '\'' || digits)) return i;
  size_t end = i + 1;
  while (end < text.size() && text[end] != text[i]) end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

inline CodeAndComments split(const std::string& text) {
  CodeAndComments out{text, std::string(text.size(), ' ')};
  for (size_t i = 0; i < text.size();) {
    const size_t end = endOfPart(text, i);
    const bool comment = text[i] == '/';
    for (size_t at = i; at < end; ++at) {
      if (text[at] == '\n') continue;
      if (comment) out.comments[at] = text[at];
      out.code[at] = ' ';
    }
    i = std::max(end, i + 1);
  }
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') out.comments[i] = '\n';
  return out;
}

}  // namespace sidestep::testing
