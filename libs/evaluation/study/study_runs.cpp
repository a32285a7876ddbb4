// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_runs.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <limits>
#include <mutex>
#include <sstream>
#include <thread>

#include "core/errors.h"

namespace sidestep {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line)
    if (c == ',')
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

/// A message as one cell of a CSV.
std::string asCell(std::string text) {
  text = text.substr(0, text.find('\n'));
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '"', '\'');
  return text.empty() ? "failed" : text;
}

void writeAll(int file, const std::string& text, const std::string& name) {
  size_t done = 0;
  while (done < text.size()) {
    const auto n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw DatasetError::missing(name + ": cannot be written: " + std::strerror(errno));
    done += static_cast<size_t>(n);
  }
}

bool parseNumber(const std::string& cell, double& value) {
  value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty()) return true;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

template <class Names>
size_t position(const Names& names, const std::string& name) {
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

RunsFile::RunsFile(const Study& study, const std::string& file, bool resume)
    : study_(study), name_(file), metrics_(namesOf(study.runner().metrics())), there_(study.size(), false) {
  std::string kept;
  if (resume && std::filesystem::exists(file)) {
    std::ifstream in(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    takeOver(text);
  }
  file_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) throw DatasetError::missing(file + ": cannot be written: " + std::strerror(errno));
  kept = header();
  for (const auto& run : runs_) kept += line(run);
  writeAll(file_, kept, name_);
}

RunsFile::~RunsFile() {
  if (file_ >= 0) ::close(file_);
}

size_t RunsFile::index(size_t row, size_t algorithm, size_t run) const {
  return (row * study_.algorithms().size() + algorithm) * static_cast<size_t>(study_.runs) + run;
}

std::string RunsFile::header() const {
  std::string out = "scenario,algorithm,run,status";
  for (const auto& m : metrics_) {
    out += ',';
    out += m;
  }
  return out + "\n";
}

std::string RunsFile::line(const StudyRun& run) const {
  std::string out = study_.rows()[run.row].name + "," + study_.algorithms()[run.algorithm] + "," +
                    std::to_string(run.run) + "," + run.status;
  for (const double v : run.values) {
    out += ',';
    if (std::isfinite(v)) out += shortestNumber(v);
  }
  return out + "\n";
}

void RunsFile::takeOver(const std::string& text) {
  const std::string head = header();
  const std::string start = text.substr(0, head.size());
  if (start != head.substr(0, start.size()))
    throw ConfigError(name_ + ": is not of this study (other columns); give another --output, or --overwrite");
  std::istringstream in(text.substr(std::min(text.size(), head.size())));
  for (std::string row; std::getline(in, row);) {
    StudyRun run;
    if (in.eof() || !parse(row, run)) continue;  // cut, or no longer part of the study
    const size_t at = index(run.row, run.algorithm, run.run);
    if (there_[at]) continue;
    there_[at] = true;
    runs_.push_back(std::move(run));
  }
}

bool RunsFile::parse(const std::string& line, StudyRun& run) const {
  const auto c = cells(line);
  if (c.size() != 4 + metrics_.size()) return false;
  const auto& rows = study_.rows();
  run.row = static_cast<size_t>(std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == c[0]; }) -
                                rows.begin());
  run.algorithm = position(study_.algorithms(), c[1]);
  double number = -1;
  if (run.row == rows.size() || run.algorithm == study_.algorithms().size() || !parseNumber(c[2], number)) return false;
  if (!(number >= 0 && number < study_.runs)) return false;
  run.run = static_cast<size_t>(number);
  run.status = c[3];
  run.values.resize(metrics_.size());
  for (size_t i = 0; i < metrics_.size(); ++i)
    if (!parseNumber(c[4 + i], run.values[i])) return false;
  return true;
}

void RunsFile::add(StudyRun&& run) {
  writeAll(file_, line(run), name_);
  there_[index(run.row, run.algorithm, run.run)] = true;
  runs_.push_back(std::move(run));
}

void RunsFile::finish() {
  std::sort(runs_.begin(), runs_.end(), [this](const auto& a, const auto& b) {
    return index(a.row, a.algorithm, a.run) < index(b.row, b.algorithm, b.run);
  });
  const std::string next = name_ + ".next";
  std::ofstream out(next, std::ios::binary);
  out << header();
  for (const auto& run : runs_) out << line(run);
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(next, name_, error);
  if (!out || error) throw DatasetError::missing(name_ + ": cannot be written; is the disk full?");
}

namespace {

StudyRun runOne(const Study& study, size_t row, size_t algorithm, size_t number) {
  StudyRun run{row, algorithm, number, "done", {}};
  try {
    run.values = study.runner().run(study.place(row, algorithm, number));
  } catch (const std::exception& e) {
    run.status = asCell(e.what());
  }
  run.values.resize(study.runner().metrics().size(), std::numeric_limits<double>::quiet_NaN());
  return run;
}

}  // namespace

void runMatrix(const Study& study, RunsFile& file, int jobs, const std::function<bool()>& stop,
               const std::function<void(size_t, size_t)>& progress) {
  const size_t per_cell = static_cast<size_t>(study.runs), algorithms = study.algorithms().size();
  std::vector<size_t> todo;
  for (size_t i = 0; i < study.size(); ++i)
    if (!file.has(i / per_cell / algorithms, i / per_cell % algorithms, i % per_cell)) todo.push_back(i);
  std::atomic<size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  const auto work = [&] {
    for (;;) {
      if (failed || stop()) return;
      const size_t k = next++;
      if (k >= todo.size()) return;
      const size_t i = todo[k];
      auto run = runOne(study, i / per_cell / algorithms, i / per_cell % algorithms, i % per_cell);
      const std::lock_guard lock(mutex);
      try {
        file.add(std::move(run));
        progress(file.runs().size(), study.size());
      } catch (...) {
        if (!failure) failure = std::current_exception();
        failed = true;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int t = 1; t < jobs; ++t) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace sidestep
