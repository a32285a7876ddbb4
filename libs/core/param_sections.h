// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <any>
#include <vector>

#include "core/errors.h"
#include "core/params.h"

namespace sidestep {

/// A group of parameters whose type only its owner knows: what a row of a table of parts (sensors, filters) names.
struct ParamSection {
  const char* key;
  const char* meaning;
  std::any (*defaults)();
  void (*visit)(std::any& params, ParamVisitor& v);
};

template <class Params>
ParamSection paramSection(const char* key, const char* meaning) {
  return {key, meaning, [] { return std::any(Params{}); },
          [](std::any& params, ParamVisitor& v) { std::any_cast<Params&>(params).visit(v); }};
}

/// The parameters of a table's rows, one value a section.
class ParamSections {
 public:
  /// Sections that are null or named already are passed over.
  explicit ParamSections(const std::vector<const ParamSection*>& sections) {
    for (const auto* section : sections) {
      const auto same = [&](const Entry& e) { return e.section == section; };
      if (section != nullptr && std::none_of(entries_.begin(), entries_.end(), same))
        entries_.push_back({section, section->defaults()});
    }
  }
  void visit(ParamVisitor& v) {
    for (auto& e : entries_)
      v.section(e.section->key, e.section->meaning, [&e](ParamVisitor& inner) { e.section->visit(e.params, inner); });
  }

  /// The section of that type, for example `of<GpsParams>()`. @throws Error (internal) if there is none
  template <class Params>
  const Params& of() const {
    for (const auto& e : entries_)
      if (const auto* p = std::any_cast<Params>(&e.params)) return *p;
    throw ConfigError("no section holds parameters of this type");
  }
  template <class Params>
  Params& of() {
    for (auto& e : entries_)
      if (auto* p = std::any_cast<Params>(&e.params)) return *p;
    throw ConfigError("no section holds parameters of this type");
  }

 private:
  struct Entry {
    const ParamSection* section;
    std::any params;
  };
  std::vector<Entry> entries_;
};

}  // namespace sidestep
