// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Feeds broken logs to the reader:  fuzz_rawlog_reader CORPUS_DIR [--seconds 60] [--seed N]
// A run passes if the reader comes back in time with observations in order and nothing thrown. The input of one that
// does not is kept as fuzz-failure.rawlog; a crash of this process leaves it in fuzz-current.rawlog.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "datasets/log_reader.h"

namespace {

using Clock = std::chrono::steady_clock;
constexpr double kSlowest_s = 30;
const std::string kCurrent = "fuzz-current.rawlog";

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void store(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// What is wrong with how the reader took this file; empty if nothing.
std::string readOnce(const std::string& file) {
  sidestep::LogReaderOptions options;
  options.memory_limit_bytes = 256u << 20;
  options.seconds_per_entry = 2;
  const auto start = Clock::now();
  try {
    sidestep::LogReader reader(file, options);
    double last_s = 0;
    while (const auto entry = reader.next()) {
      if (!std::isfinite(entry->time_s) || entry->time_s <= 0) return "a stamp that is none came through";
      if (entry->time_s < last_s) return "out of order";
      if (!entry->observation) return "a null observation came through";
      last_s = entry->time_s;
    }
    if (reader.end().damaged == reader.end().message.empty()) return "damage without message or the reverse";
  } catch (const std::exception& error) {
    return std::string("thrown: ") + error.what();
  }
  return secondsSince(start) > kSlowest_s ? "too slow" : "";
}

class Mutator {
 public:
  Mutator(std::vector<std::string> corpus, unsigned seed) : corpus_(std::move(corpus)), random_(seed) {}

  std::string next() {
    std::string bytes = corpus_[below(corpus_.size())];
    for (size_t n = 1 + below(4); n > 0; --n) mutate(bytes);
    return bytes;
  }

 private:
  size_t below(size_t n) { return n == 0 ? 0 : std::uniform_int_distribution<size_t>(0, n - 1)(random_); }

  void mutate(std::string& bytes) {
    const size_t at = below(bytes.size());
    const std::string& other = corpus_[below(corpus_.size())];
    switch (below(6)) {
      case 0:
        return flip(bytes, at);
      case 1:
        return bytes.resize(at);
      case 2:
        bytes = bytes.substr(0, at) + other.substr(below(other.size()));
        return;
      case 3:
        bytes.insert(at, "\xff\xff\xff\xff");
        return;
      case 4:
        bytes.replace(at, 4, "\xff\xff\xff\xff");
        return;
      default:
        bytes.insert(at, bytes.substr(below(bytes.size()), below(2000)));
        return;
    }
  }

  void flip(std::string& bytes, size_t at) {
    if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
  }

  std::vector<std::string> corpus_;
  std::mt19937 random_;
};

std::vector<std::string> readCorpus(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".rawlog") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> out;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    out.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return out;
}

int run(const std::string& folder, double seconds, unsigned seed) {
  std::vector<std::string> corpus = readCorpus(folder);
  if (corpus.empty()) {
    std::fprintf(stderr, "fuzz_rawlog_reader: error: no *.rawlog in %s\n", folder.c_str());
    return 3;
  }
  Mutator mutator(corpus, seed);
  const auto start = Clock::now();
  size_t passed = 0, failed = 0;
  for (size_t n = 0; n < corpus.size() || secondsSince(start) < seconds; ++n) {
    const std::string bytes = n < corpus.size() ? corpus[n] : mutator.next();
    store(kCurrent, bytes);
    const std::string wrong = readOnce(kCurrent);
    wrong.empty() ? ++passed : ++failed;
    if (!wrong.empty()) {
      store("fuzz-failure.rawlog", bytes);
      std::fprintf(stderr, "run %zu, seed %u: %s; kept as fuzz-failure.rawlog\n", n, seed, wrong.c_str());
    }
    if (n % 500 == 499) std::fprintf(stderr, "%zu logs, %.0f s\n", n + 1, secondsSince(start));
  }
  std::filesystem::remove(kCurrent);
  std::printf("%zu passed, %zu failed\n", passed, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder;
  double seconds = 60;
  unsigned seed = 1;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      if (word == "--seconds" && i + 1 < argc)
        seconds = std::stod(argv[++i]);
      else if (word == "--seed" && i + 1 < argc)
        seed = static_cast<unsigned>(std::stoul(argv[++i]));
      else
        folder = word;
    }
  } catch (const std::exception&) {
    folder.clear();
  }
  if (folder.empty() || folder.starts_with("-")) {
    std::fprintf(stderr, "usage: fuzz_rawlog_reader CORPUS_DIR [--seconds 60] [--seed N]\n");
    return 2;
  }
  return run(folder, seconds, seed);
}
