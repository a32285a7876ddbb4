// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "localization/filters/filters.h"

#include "core/errors.h"
#include "localization/filters/ekf.h"
#include "localization/filters/mcl.h"
#include "localization/filters/particle_filter.h"
#include "localization/filters/scan_model.h"
#include "maps/grid_map.h"

namespace sidestep {
namespace {

const ParamSection kEkf = paramSection<EkfParams>("ekf", "extended Kalman filter (section 3.1)");
const ParamSection kPf = paramSection<PfParams>("pf", "particle filter (section 3.2)");
const ParamSection kMcl = paramSection<MclParams>("mcl", "Monte Carlo localization in a map");

std::optional<double> ekfGate(const ParamSections& p) {
  const auto& ekf = p.of<EkfParams>();
  return ekf.gate ? ekf.gate_probability : 1;
}

std::optional<double> pfGate(const ParamSections& p) {
  const auto& pf = p.of<PfParams>();
  return pf.likelihood == "gaussian" ? pf.gate_probability : 1;
}

double ekfOffset(const ParamSections& p) { return p.of<EkfParams>().heading_offset_sd; }
double pfOffset(const ParamSections& p) { return p.of<PfParams>().heading_offset_sd; }
double mclOffset(const ParamSections& p) { return p.of<MclParams>().engine.heading_offset_sd; }
bool pfJoins(const ParamSections& p) { return p.of<PfParams>().likelihood == "printed"; }

std::unique_ptr<PoseFilter> ekf(const ParamSections& p, const FilterInputs&) { return makeEkf(p.of<EkfParams>()); }

std::unique_ptr<PoseFilter> pf(const ParamSections& p, const FilterInputs& in) {
  return makeParticleFilter(p.of<PfParams>(), in.seed);
}

std::unique_ptr<PoseFilter> mcl(const ParamSections& p, const FilterInputs& in) {
  const auto& params = p.of<MclParams>();
  const auto model = std::make_shared<ScanModel>(*in.map, params.scan);
  return makeMcl(params, in.seed, model, in.start_is_unknown);
}

}  // namespace

const std::vector<FilterRow>& filters() {
  static const std::vector<FilterRow> kRows = {
      {.name = "ekf",
       .about = "extended Kalman filter",
       .section = &kEkf,
       .can_smooth = true,
       .gate_probability = ekfGate,
       .heading_offset_sd = ekfOffset,
       .make = ekf},
      {.name = "pf",
       .about = "particle filter",
       .section = &kPf,
       .gate_probability = pfGate,
       .heading_offset_sd = pfOffset,
       .joins_instants = pfJoins,
       .make = pf},
      {.name = "mcl",
       .about = "Monte Carlo localization: a laser in a map",
       .section = &kMcl,
       .needs_map = true,
       .heading_offset_sd = mclOffset,
       .make = mcl},
      {.name = "odometry",
       .about = "odometry alone",
       .section = &kEkf,
       .can_smooth = true,
       .odometry_only = true,
       .heading_offset_sd = ekfOffset,
       .make = ekf},
  };
  return kRows;
}

std::vector<std::string> filterNames() {
  std::vector<std::string> out;
  for (const auto& row : filters()) out.emplace_back(row.name);
  return out;
}

const FilterRow& filterOf(const std::string& name) {
  for (const auto& row : filters())
    if (name == row.name) return row;
  const auto near = nearestWord(name, filterNames());
  throw ConfigError("no filter '" + name + "'" + (near.empty() ? "" : "; did you mean '" + near + "'?"));
}

std::string filtersWith(bool FilterRow::*trait) {
  std::string out;
  for (const auto& row : filters())
    if (row.*trait) out += (out.empty() ? "" : ", ") + std::string(row.name);
  return out;
}

ParamSections filterParams() {
  std::vector<const ParamSection*> sections;
  for (const auto& row : filters()) sections.push_back(row.section);
  return ParamSections(sections);
}

}  // namespace sidestep
