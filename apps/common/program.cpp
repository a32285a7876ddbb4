// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace sidestep {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;
std::string command_line;

void onInterrupt(int) {
  interrupt_count = interrupt_count + 1;
  if (interrupt_count > 1) _exit(static_cast<int>(ExitCode::kInterrupted));
}

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string shellQuoted(const std::string& word) {
  static const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string out = "'";
  for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  for (const auto* sub : app.get_subcommands({})) {
    const auto more = optionNames(*sub);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

int usageError(const std::string& program, const CLI::App& app, int argc, char** argv, const std::string& message) {
  std::string hint;
  const auto known = optionNames(app);
  for (int i = 1; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!word.starts_with("--") || std::find(known.begin(), known.end(), word) != known.end()) continue;
    const auto near = nearestWord(word, known);
    if (!near.empty()) hint = "; did you mean " + near + "?";
  }
  std::string line = message.substr(0, message.find('\n'));
  std::fprintf(stderr, "%s: error: %s%s (see %s --help)\n", program.c_str(), line.c_str(), hint.c_str(),
               program.c_str());
  return static_cast<int>(ExitCode::kUsage);
}

}  // namespace

bool interrupted() { return interrupt_count > 0; }
const std::string& commandLine() { return command_line; }

int runProgram(int argc, char** argv, CLI::App& app, const std::function<ExitCode()>& work) {
  const std::string program = app.get_name();
  command_line = program;
  for (int i = 1; i < argc; ++i) command_line += " " + shellQuoted(argv[i]);
  app.set_version_flag("--version", program + " " SIDESTEP_VERSION, "print the version and exit");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    return usageError(program, app, argc, argv, e.what());
  }
  std::signal(SIGINT, onInterrupt);
  std::signal(SIGTERM, onInterrupt);
  try {
    return static_cast<int>(work());
  } catch (const Error& e) {
    std::fprintf(stderr, "%s: error: %s\n", program.c_str(), e.what());
    return static_cast<int>(e.code());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: internal error: %s\n", program.c_str(), e.what());
    return static_cast<int>(ExitCode::kInternalError);
  }
}

ProgressBar::ProgressBar(std::string what, bool quiet)
    : what_(std::move(what)), shown_(!quiet && isatty(STDERR_FILENO) == 1), started_s_(steadySeconds()) {}

ProgressBar::~ProgressBar() {
  if (shown_ && last_s_ > 0) std::fprintf(stderr, "\r\033[K");
}

void ProgressBar::update(double fraction) {
  if (!shown_) return;
  const double now = steadySeconds();
  if (now - last_s_ < 0.1) return;
  last_s_ = now;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(kWidth * std::min(1.0, std::max(0.0, fraction)));
  const double left = fraction > 0.01 ? (now - started_s_) * (1 / fraction - 1) : 0;
  std::fprintf(stderr, "\r%s [%s%s] %3.0f %%, %.0f s left \033[K", what_.c_str(),
               std::string(static_cast<size_t>(filled), '#').c_str(),
               std::string(static_cast<size_t>(kWidth - filled), ' ').c_str(), 100 * fraction, left);
}

OutputFolder::OutputFolder(const std::string& path, bool overwrite) : path_(path) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::exists(path) && !fs::is_directory(path))
    throw ConfigError(path + ": is a file, not a folder; give another --output");
  if (fs::is_directory(path) && !fs::is_empty(path, error) && !overwrite)
    throw ConfigError(path + ": the output folder holds something; give another --output, or --overwrite");
  fs::create_directories(path, error);
  if (error) throw ConfigError(path + ": cannot be created: " + error.message());
}

std::string OutputFolder::file(const std::string& name) const {
  return (std::filesystem::path(path_) / name).string();
}

void OutputFolder::writeText(const std::string& name, const std::string& text) const {
  std::ofstream out(file(name), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw DatasetError::missing(file(name) + ": cannot be written; is the disk full?");
}

void OutputFolder::writeConfiguration(const Visit& fields) const {
  writeText("effective.yaml", "# " + commandLine() + "\n" + writeYaml(fields));
  writeText("command.txt", commandLine() + "\n");
}

}  // namespace sidestep
