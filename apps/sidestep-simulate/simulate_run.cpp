// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/simulate_run.h"

#include <cstdio>

#include "common/program.h"
#include "evaluation/experiments/world_check.h"
#include "figures/world_figure.h"
#include "sidestep-simulate/localization_run.h"
#include "sidestep-simulate/world_run.h"

namespace sidestep {
namespace {

/// @throws ConfigError with all that overlaps or cannot be reached, unless that is to be run anyway.
void checkWorld(const SimulateOptions& options, const Scenario& scenario, const WorldInputs& inputs) {
  const auto problems = findProblems(scenario.world.world, inputs.walls);
  if (problems.empty()) return;
  const std::string text = describe(problems, options.scenario, textOf(options.scenario));
  if (!options.force) throw ConfigError(text + "\n(--force runs it anyway)");
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace

ExitCode simulate(const SimulateOptions& options) {
  Scenario config = effectiveScenario(options);
  const Visit fields = [&](ParamVisitor& v) { config.visit(v); };
  if (options.write_config) {
    std::fputs(writeYaml(fields).c_str(), stdout);
    return ExitCode::kDone;
  }
  if (options.scenario.empty())
    throw ConfigError("no SCENARIO given; for example sidestep-simulate share/scenarios/circle.yaml -o out");
  config.check();
  if (options.video && config.kind != "world") throw ConfigError("--video: only of scenarios of kind: world");
  if (options.explain && config.kind != "world") throw ConfigError("--explain: only of scenarios of kind: world");
  if (options.video) requireFfmpeg();
  WorldInputs inputs;
  if (config.kind == "world") {
    inputs = readWorldInputs(config.world.world, options.scenario);
    checkWorld(options, config, inputs);
  }
  const OutputFolder folder(options.output, options.overwrite);
  folder.writeConfiguration(fields);
  return config.kind == "world" ? runWorld(options, config, inputs, folder) : runLocalization(options, config, folder);
}

}  // namespace sidestep
