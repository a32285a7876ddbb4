// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/errors.h"

namespace sidestep {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

[[noreturn]] void fail(const std::string& what) { throw Error(ExitCode::kInternalError, what); }

File temporaryFile(const std::string& content) {
  File file(std::tmpfile(), &std::fclose);
  if (!file) fail(std::string("gnuplot: no temporary file: ") + std::strerror(errno));
  const bool written = std::fwrite(content.data(), 1, content.size(), file.get()) == content.size();
  if (!written || std::fflush(file.get()) != 0) fail(std::string("gnuplot: temporary file: ") + std::strerror(errno));
  std::rewind(file.get());
  return file;
}

pid_t spawnGnuplot(int in, int out) {
  // Read as a named file, gnuplot stops at the first error; from a pipe or `-` it would go on.
  std::array<std::string, 3> words{"gnuplot", "-d", "/dev/stdin"};
  std::array<char*, 4> argv{words[0].data(), words[1].data(), words[2].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out, STDERR_FILENO);
  pid_t child = 0;
  const int error = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) fail("gnuplot not found: install gnuplot-nox");
  if (error != 0) fail(std::string("gnuplot cannot be run: ") + std::strerror(error));
  return child;
}

/// The last line in the file that is not blank: gnuplot's messages end with what is wrong.
std::string lastLine(std::FILE* file) {
  std::rewind(file);
  std::array<char, 1000> buffer;
  std::string last;
  while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), file)) {
    std::string line(buffer.data());
    line.erase(line.find_last_not_of(" \t\r\n") + 1);
    line.erase(0, line.find_first_not_of(" \t"));
    if (!line.empty()) last = line;
  }
  return last;
}

int waitFor(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

}  // namespace

const char* figureColour(size_t index) {
  static const std::array<const char*, 12> kColours = {"#0072b2", "#e69f00", "#009e73", "#d55e00",
                                                       "#cc79a7", "#56b4e9", "#f0e442", "#404040",
                                                       "#882255", "#332288", "#999933", "#bbbbbb"};
  return kColours[index % kColours.size()];
}

std::string gnuplotQuoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + "'";
}

void runGnuplot(const std::string& script, const std::string& what) {
  const File in = temporaryFile(script), out = temporaryFile("");
  const int status = waitFor(spawnGnuplot(fileno(in.get()), fileno(out.get())));
  if (status != 0) fail(what + ": gnuplot failed: " + lastLine(out.get()));
}

}  // namespace sidestep
