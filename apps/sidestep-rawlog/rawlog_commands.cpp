// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-rawlog/rawlog_commands.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/program.h"
#include "datasets/kind_rules.h"
#include "datasets/log_degrader.h"
#include "datasets/log_writer.h"
#include "sidestep-rawlog/rawlog_report.h"

namespace sidestep {
namespace {

LogReaderOptions readerOptions(const RawlogOptions& options) {
  LogReaderOptions out;
  out.labels = labelMap(options.labels);
  return out;
}

LogHealth examine(const RawlogOptions& options) {
  ProgressBar bar("reading", options.quiet);
  return examineLog(options.log, readerOptions(options), [&](uint64_t done, uint64_t size) {
    if (interrupted()) throw Error(ExitCode::kInterrupted, "interrupted");
    bar.update(size > 0 ? static_cast<double>(done) / static_cast<double>(size) : 1);
  });
}

void checkOutput(const RawlogOptions& options) {
  std::error_code none;
  if (std::filesystem::equivalent(options.log, options.output, none))
    throw ConfigError(options.output + ": is the log itself; give another --output");
  if (std::filesystem::exists(options.output, none) && !options.overwrite)
    throw ConfigError(options.output + ": is there already; give another --output, or --overwrite");
}

ExitCode codeOf(const LogHealth& health) { return health.end.damaged ? ExitCode::kInputCorrupt : ExitCode::kDone; }

}  // namespace

ExitCode showLog(const RawlogOptions& options) {
  const LogHealth health = examine(options);
  std::fputs((options.json ? healthJson(health) : healthText(health)).c_str(), stdout);
  return codeOf(health);
}

ExitCode checkLog(const RawlogOptions& options) {
  LogHealth health = examine(options);
  if (options.json) {
    std::fputs(healthJson(health).c_str(), stdout);
    return codeOf(health);
  }
  std::printf("%s: %s\n", health.file.c_str(), word(health.verdict).c_str());
  for (const std::string& reason : health.reasons) std::printf("  %s\n", printable(reason).c_str());
  return codeOf(health);
}

ExitCode recoverDamagedLog(const RawlogOptions& options) {
  checkOutput(options);
  const RecoveryReport report = recoverLog(options.log, options.output);
  std::fputs((options.json ? recoveryJson(report, options.output) : recoveryText(report, options.output)).c_str(),
             stdout);
  return report.entries == 0 ? ExitCode::kInputCorrupt : ExitCode::kDone;
}

ExitCode degradeLog(const RawlogOptions& options) {
  DegradeScript script;
  readYaml(options.script, [&](ParamVisitor& v) { script.visit(v); });
  script.check();
  LogReader reader(options.log, readerOptions(options));
  checkOutput(options);
  LogWriter writer(options.output, commandLine() + "\n" + writeYaml([&](ParamVisitor& v) { script.visit(v); }));
  DegradeReport report;
  LogDegrader degrader(script, [&](const Reading& entry) {
    writer.write(*entry.observation);
    ++report.written;
  });
  ProgressBar bar("degrading", options.quiet);
  while (auto entry = reader.next()) {
    if (interrupted()) throw Error(ExitCode::kInterrupted, "interrupted");
    degrader.push(*entry);
    if (++report.read % 256 == 0)
      bar.update(static_cast<double>(reader.bytesConsumed()) / std::max(1.0, static_cast<double>(reader.fileSize())));
  }
  degrader.finish();
  writer.close();
  report.events = degrader.counts();
  std::fputs((options.json ? degradeJson(report, options.output) : degradeText(report, options.output)).c_str(),
             stdout);
  if (reader.end().damaged) std::fprintf(stderr, "sidestep-rawlog: %s\n", reader.end().message.c_str());
  return reader.end().damaged ? ExitCode::kInputCorrupt : ExitCode::kDone;
}

}  // namespace sidestep
