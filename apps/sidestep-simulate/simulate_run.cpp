// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-simulate/simulate_run.h"

#include <cstdio>

#include "common/program.h"
#include "figures/world_figure.h"
#include "sidestep-simulate/localization_run.h"
#include "sidestep-simulate/world_run.h"

namespace sidestep {

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
  const OutputFolder folder(options.output, options.overwrite);
  folder.writeConfiguration(fields);
  return config.kind == "world" ? runWorld(options, config, folder) : runLocalization(options, config, folder);
}

}  // namespace sidestep
