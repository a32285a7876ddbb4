// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace sidestep::testing {

using support::TemporaryFolder;

inline std::string readFile(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void writeFile(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

inline std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if it was killed
  std::string out, err;
};

/// Runs a shell command as a user would, our programs on the PATH, in `folder` (the source tree if empty).
inline ProgramResult runShell(const std::string& command, const std::filesystem::path& folder = SIDESTEP_SOURCE) {
  const TemporaryFolder t;
  writeFile(t / "command.sh",
            "PATH=" SIDESTEP_BIN ":$PATH\ncd '" + folder.string() + "' || exit 99\n" + command + "\n");
  const std::string line = "sh '" + (t / "command.sh").string() + "' >'" + (t / "out").string() + "' 2>'" +
                           (t / "err").string() + "' </dev/null";
  const int status = std::system(line.c_str());
  ProgramResult r;
  r.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  r.out = readFile(t / "out");
  r.err = readFile(t / "err");
  return r;
}

/// Names of all our built programs.
inline std::vector<std::string> programs() {
  std::vector<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator(SIDESTEP_BIN))
    if (entry.path().filename().string().starts_with("sidestep-")) out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

/// The sub-commands that a help text lists.
inline std::vector<std::string> subcommandsIn(const std::string& help) {
  std::vector<std::string> out;
  bool inside = false;
  for (const auto& line : linesOf(help)) {
    if (!line.starts_with(" ")) inside = line.starts_with("Subcommands:");
    std::smatch word;
    static const std::regex entry("^  ([a-z][a-z-]*)( .*)?$");
    if (inside && std::regex_match(line, word, entry)) out.push_back(word[1]);
  }
  return out;
}

/// The help of a program, followed by that of each of its sub-commands.
inline std::string wholeHelp(const std::string& program) {
  std::string help = runShell(program + " --help").out;
  for (const auto& sub : subcommandsIn(help)) help += runShell(program + " " + sub + " --help").out;
  return help;
}

/// All `--words` of a text.
inline std::set<std::string> optionsIn(const std::string& text) {
  static const std::regex option("(^|[^A-Za-z0-9-])(--[a-z][a-z0-9-]*)");
  std::set<std::string> out;
  for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it) out.insert((*it)[2]);
  return out;
}

}  // namespace sidestep::testing
