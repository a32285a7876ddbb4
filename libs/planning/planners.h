// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <any>
#include <memory>
#include <string>
#include <vector>

#include "core/errors.h"
#include "core/params.h"
#include "planning/local_planner.h"

namespace sidestep {

/// A section of parameters that one planner of the table, or several, read.
struct PlannerSection {
  const char* key;
  const char* about;
  std::any (*defaults)();
  void (*visit)(std::any& params, ParamVisitor& v);
};

/// Parameters of every local planner, one value a section of the table.
class LocalPlannerParams {
 public:
  LocalPlannerParams();
  void visit(ParamVisitor& v);

  /// The section of that type, for example `of<WindowParams>()`.
  template <class Params>
  Params& of() {
    for (auto& s : sections_)
      if (auto* p = std::any_cast<Params>(&s.params)) return *p;
    throw ConfigError("no local planner has parameters of this type");
  }
  template <class Params>
  const Params& of() const {
    return const_cast<LocalPlannerParams*>(this)->of<Params>();
  }

 private:
  struct Section {
    const PlannerSection* kind;
    std::any params;
  };
  std::vector<Section> sections_;
};

/// A local planner as the table knows it.
struct LocalPlannerRow {
  const char* name;
  const char* about;              ///< one line, for lists
  const PlannerSection* section;  ///< null: it has no parameters
  bool avoids;                    ///< whether it looks at obstacles at all: what may be offered for driving
  std::unique_ptr<LocalPlanner> (*make)(const LocalPlannerParams&, const std::string& name);
};

/// The table of all local planners. Adding one: a file that makes it, a line in planners.cpp.
const std::vector<LocalPlannerRow>& localPlanners();
/// The names of all local planners.
std::vector<std::string> localPlannerNames();
/// @throws ConfigError for an unknown name, with the nearest known one
const LocalPlannerRow& localPlanner(const std::string& name);

/// The planner of that name. @throws ConfigError as above
std::unique_ptr<LocalPlanner> makeLocalPlanner(const std::string& name, const LocalPlannerParams& params = {});

}  // namespace sidestep
