// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "common/program.h"
#include "sidestep-evaluate/evaluate_run.h"

int main(int argc, char** argv) {
  using namespace sidestep;
  EvaluateOptions o;
  CLI::App app("Compares algorithms: runs a study on all cores, with tables, figures and a report.",
               "sidestep-evaluate");
  app.add_option("-c,--config,STUDY", o.study, "scenarios, algorithms and runs (YAML)")->type_name("FILE");
  app.add_option("-o,--output", o.output, "output folder")->type_name("DIR")->capture_default_str();
  app.add_flag("-w,--overwrite", o.overwrite, "write into a folder that holds something");
  app.add_flag("-q,--quiet", o.quiet, "no progress bar");
  app.add_option("-j,--jobs", o.jobs, "runs at a time; default: one a core")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  app.add_flag("--resume", o.resume, "keep the runs that the output folder holds, and do the others");
  app.add_option("--scenarios", o.scenarios, "only these of the study's scenarios; * stands for any characters")
      ->delimiter(',')
      ->type_name("LIST");
  app.add_option("--runs", o.runs, "runs of each scenario with each algorithm")
      ->check(CLI::Range(1, 1000000))
      ->type_name("N");
  app.add_option("--seed", o.seed, "of the random numbers")->check(CLI::Range(0, 2000000000))->type_name("N");
  app.add_flag("--write-config", o.write_config, "print the study with all parameters as YAML and exit");
  app.footer(
      "Example:\n"
      "  sidestep-evaluate share/studies/table-3.1-3.2.yaml --runs 2 -o out-study\n"
      "Makes runs.csv, summary.csv, report.html, figures (PNG), metrics.json, effective.yaml, command.txt.\n"
      "Exit codes: 0 done, 2 usage, 3 input missing, 4 input damaged, 6 an expectation of the study was missed,\n"
      "130 interrupted (what was finished is saved; --resume goes on).");
  return runProgram(argc, argv, app, [&] { return evaluate(o); });
}
