// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "sidestep-rawlog/rawlog_commands.h"

namespace {

using Command = sidestep::ExitCode (*)(const sidestep::RawlogOptions&);

CLI::App* addCommand(CLI::App& app, const char* name, const char* what, sidestep::RawlogOptions& o, Command command,
                     Command& chosen) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->add_option("LOG", o.log, "rawlog, plain or gzip")->type_name("")->required();
  sub->add_flag("--json", o.json, "print JSON");
  sub->add_flag("-q,--quiet", o.quiet, "no progress bar");
  sub->callback([&chosen, command] { chosen = command; });
  return sub;
}

void addLabels(CLI::App& sub, sidestep::RawlogOptions& o) {
  sub.add_option("--label", o.labels, "which label serves as a kind of sensor, e.g. gps=GPS_RTK_REAR")
      ->type_name("KIND=LABEL");
}

void addOutput(CLI::App& sub, sidestep::RawlogOptions& o, const std::string& otherwise) {
  sub.add_option("-o,--output", o.output, "log to write; default " + otherwise)->type_name("FILE");
  sub.add_flag("-w,--overwrite", o.overwrite, "write over a file that is there");
}

constexpr const char* kRecovered = "recovered.rawlog";
constexpr const char* kDegraded = "degraded.rawlog";
constexpr const char* kLog = "/usr/share/mrpt/datasets/uwb_ro-localization_demo.rawlog";

std::string example(const std::string& command, const std::string& rest = "") {
  return "Example (a real log that comes with the Debian package mrpt-common):\n  sidestep-rawlog " + command + " " +
         kLog + rest;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace sidestep;
  RawlogOptions o;
  Command chosen = nullptr;
  CLI::App app(
      "Looks after rawlogs: what is in them, whether they are whole, what can be saved, what if less were there.",
      "sidestep-rawlog");
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 2 usage, 3 input missing, 4 damaged or cut short, 130 interrupted.\n" +
             example("info"));
  CLI::App* info = addCommand(app, "info", "what the log holds, label by label", o, showLog, chosen);
  CLI::App* check = addCommand(app, "check", "healthy, usable with care, or damaged, and why", o, checkLog, chosen);
  CLI::App* recover =
      addCommand(app, "recover", "copy what can be read of a damaged log", o, recoverDamagedLog, chosen);
  addLabels(*info, o);
  addLabels(*check, o);
  CLI::App* degrade = addCommand(app, "degrade", "do to a log what a script says: outages, delays, noise, spikes", o,
                                 degradeLog, chosen);
  addLabels(*degrade, o);
  degrade->add_option("--script", o.script, "what goes wrong, when and where (YAML)")->type_name("FILE")->required();
  addOutput(*recover, o, kRecovered);
  addOutput(*degrade, o, kDegraded);
  info->footer(example("info"));
  check->footer(example("check"));
  recover->footer(example("recover", " -o recovered.rawlog"));
  degrade->footer(example("degrade", " \\\n    --script share/scripts/outage.yaml -o degraded.rawlog"));
  return runProgram(argc, argv, app, [&] {
    if (o.output.empty()) o.output = chosen == degradeLog ? kDegraded : kRecovered;
    return chosen(o);
  });
}
