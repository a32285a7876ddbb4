// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/experiments/scenario.h"

#include "core/errors.h"

namespace sidestep {

void Scenario::visit(ParamVisitor& v) {
  v.choice("kind", kind, {"localization", "world"}, "what the scenario is about");
  v.integer("seed", seed, {0, 2e9}, "of the random numbers");
  if (kind == "world")
    world.visit(v);
  else
    localization.visit(v);
}

void Scenario::check() const {
  if (kind == "world")
    world.check();
  else
    localization.check();
}

Scenario Scenario::read(const std::string& file) {
  Scenario out;
  readYaml(file, [&](ParamVisitor& v) { out.visit(v); });
  return out;
}

WorldScenario readWorldScenario(const std::string& file) {
  Scenario out;
  out.kind = "world";
  readYaml(file, [&](ParamVisitor& v) { out.visit(v); });
  if (out.kind != "world") throw ConfigError(file + ": kind = " + out.kind + ": is no world");
  return std::move(out.world);
}

}  // namespace sidestep
