// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "core/errors.h"
#include "core/params.h"

namespace sidestep {
namespace {

/// One map of the file: looks its keys up, and knows in the end which of them nobody asked for.
class YamlReader final : public ParamVisitor {
 public:
  YamlReader(const YAML::Node& map, std::string file, std::string prefix)
      : map_(map), file_(std::move(file)), prefix_(std::move(prefix)) {
    if (map_.IsNull() || !map_.IsDefined()) return;
    const std::string self = prefix_.empty() ? "the file" : prefix_.substr(0, prefix_.size() - 1);
    if (!map_.IsMap()) fail(map_, self, "is not a map of keys");
    for (const auto& item : map_) {
      if (!item.first.IsScalar()) fail(item.first, self, "has a key that is not a word");
      const auto key = item.first.as<std::string>();
      if (entries_.count(key)) fail(item.first, prefix_ + key, "is given twice");
      entries_.emplace(key, item.second);
      marks_.emplace(key, item.first);
    }
  }

  void number(const std::string& key, double& v, Range r, const std::string& unit, const std::string&) override {
    if (auto n = take(key)) v = toNumber(*n, prefix_ + key, r, unit);
  }
  void integer(const std::string& key, int& v, Range r, const std::string&) override {
    auto n = take(key);
    if (!n) return;
    const double x = toNumber(*n, prefix_ + key, r, "");
    if (x != std::floor(x) || std::abs(x) > 2e9) fail(*n, prefix_ + key, "= " + n->Scalar() + " is not an integer");
    v = static_cast<int>(x);
  }
  void flag(const std::string& key, bool& v, const std::string&) override {
    auto n = take(key);
    if (!n) return;
    if (!n->IsScalar() || (n->Scalar() != "true" && n->Scalar() != "false"))
      fail(*n, prefix_ + key, "= " + shown(*n) + ", allowed true, false");
    v = n->Scalar() == "true";
  }
  void choice(const std::string& key, std::string& v, const std::vector<std::string>& words,
              const std::string&) override {
    auto n = take(key);
    if (!n) return;
    std::string allowed;
    for (const auto& w : words) {
      if (n->IsScalar() && n->Scalar() == w) {
        v = w;
        return;
      }
      allowed += (allowed.empty() ? "" : ", ") + w;
    }
    fail(*n, prefix_ + key, "= " + shown(*n) + ", allowed " + allowed + hint(shown(*n), words));
  }
  void text(const std::string& key, std::string& v, const std::string&) override {
    auto n = take(key);
    if (!n) return;
    if (!n->IsScalar()) fail(*n, prefix_ + key, "is not a text");
    v = n->Scalar();
  }
  void texts(const std::string& key, std::vector<std::string>& v, const std::string&) override {
    auto n = take(key);
    if (!n) return;
    if (!n->IsSequence()) fail(*n, prefix_ + key, "is not a list");
    v.clear();
    for (const auto& item : *n) {
      if (!item.IsScalar()) fail(item, prefix_ + key, "holds something that is not a text");
      v.push_back(item.Scalar());
    }
  }
  void table(const std::string& key, const std::vector<std::string>& columns, Table& rows,
             const std::string&) override {
    auto n = take(key);
    if (!n) return;
    if (!n->IsSequence()) fail(*n, prefix_ + key, "is not a list of rows");
    rows.clear();
    for (const auto& item : *n) {
      std::vector<double> row(columns.size(), std::numeric_limits<double>::quiet_NaN());
      YamlReader reader(item, file_, prefix_ + key + "[" + std::to_string(rows.size()) + "].");
      for (size_t i = 0; i < columns.size(); ++i) {
        if (!reader.entries_.count(columns[i])) fail(item, reader.prefix_ + columns[i], "is missing");
        const bool degrees = columns[i].ends_with("_deg");
        if (degrees)
          reader.angle(columns[i], row[i], {}, "");
        else
          reader.number(columns[i], row[i], {}, "", "");
      }
      reader.finish();
      rows.push_back(row);
    }
  }
  void section(const std::string& key, const std::string&, const Visit& fields) override {
    auto n = take(key);
    YamlReader reader(n ? *n : YAML::Node(), file_, prefix_ + key + ".");
    fields(reader);
    reader.finish();
  }
  void groups(const std::string& key, std::vector<std::string>& names, const std::string&,
              const std::function<void(const std::string&, ParamVisitor&)>& fields) override {
    const auto n = take(key);
    if (n) names.clear();
    YamlReader all(n ? *n : YAML::Node(), file_, prefix_ + key + ".");
    if (n && n->IsMap())
      for (const auto& item : *n) names.push_back(item.first.as<std::string>());
    for (const auto& name : names) all.section(name, "", [&](ParamVisitor& v) { fields(name, v); });
  }
  void overlay(const std::string& key, std::string& yaml, const std::string&) override {
    const auto n = take(key);
    if (!n) return;
    if (!n->IsMap() && !n->IsNull()) fail(*n, prefix_ + key, "is not a map of keys");
    // Counted from the first key: the mark of a map with an anchor is that of the anchor.
    yaml.clear();
    if (n->size() == 0) return;
    const int line = n->begin()->first.Mark().line;
    yaml = std::string(static_cast<size_t>(std::max(0, line)), '\n') + YAML::Dump(*n) + "\n";
  }

  /// All keys that were not asked for are unknown.
  void finish() const {
    for (const auto& [key, node] : marks_)
      if (!known_.count(key)) fail(node, prefix_ + key, "is no known key" + hint(key, {known_.begin(), known_.end()}));
  }

 private:
  std::optional<YAML::Node> take(const std::string& key) {
    known_.insert(key);
    const auto it = entries_.find(key);
    if (it == entries_.end()) return std::nullopt;
    return it->second;
  }

  double toNumber(const YAML::Node& n, const std::string& name, Range r, const std::string& unit) const {
    double value = 0;
    const std::string s = n.IsScalar() ? n.Scalar() : "";
    const char* first = s.c_str() + (s.starts_with("+") ? 1 : 0);
    const auto [end, error] = std::from_chars(first, s.c_str() + s.size(), value);
    if (s.empty() || error != std::errc() || end != s.c_str() + s.size())
      fail(n, name, "= " + shown(n) + " is not a number");
    if (!std::isfinite(value)) fail(n, name, "= " + s + " is not finite");
    if (value < r.low || value > r.high) {
      std::string allowed =
          std::isfinite(r.low) && std::isfinite(r.high)
              ? shortestNumber(r.low) + " .. " + shortestNumber(r.high)
              : (std::isfinite(r.low) ? ">= " + shortestNumber(r.low) : "<= " + shortestNumber(r.high));
      fail(n, name, "= " + s + (unit.empty() ? "" : " " + unit) + ", allowed " + allowed);
    }
    return value;
  }

  static std::string shown(const YAML::Node& n) {
    if (n.IsScalar()) return n.Scalar();
    return n.IsSequence() ? "a list" : n.IsMap() ? "a map" : "nothing";
  }
  static std::string hint(const std::string& word, const std::vector<std::string>& known) {
    auto near = nearestWord(word, known);
    if (near.empty()) near = synonymOf(word, known);
    return near.empty() ? "" : "; did you mean '" + near + "'?";
  }
  /// Words that are no misspellings, but are meant often.
  static std::string synonymOf(const std::string& word, const std::vector<std::string>& known) {
    static const std::pair<const char*, const char*> table[] = {
        {"planner", "robot"}, {"driver", "planner"}, {"obstacles", "walls"},   {"pedestrians", "people"},
        {"humans", "people"}, {"agents", "people"},  {"time_s", "duration_s"}, {"path", "waypoints"}};
    for (const auto& [said, meant] : table)
      if (word == said && std::find(known.begin(), known.end(), meant) != known.end()) return meant;
    return "";
  }
  [[noreturn]] void fail(const YAML::Node& at, const std::string& name, const std::string& what) const {
    throw ConfigError(file_ + ":" + std::to_string(at.Mark().line + 1) + ": " + name + " " + what);
  }

  YAML::Node map_;
  std::string file_, prefix_;
  std::map<std::string, YAML::Node> entries_, marks_;
  std::set<std::string> known_;
};

}  // namespace

void readYamlText(const std::string& text, const std::string& name, const Visit& fields) {
  YAML::Node root;
  try {
    root = YAML::Load(text);
  } catch (const YAML::Exception& e) {
    throw ConfigError(name + ":" + std::to_string(e.mark.line + 1) + ": not YAML: " + e.msg);
  }
  YamlReader reader(root, name, "");
  fields(reader);
  reader.finish();
}

void readYaml(const std::string& file, const Visit& fields) {
  std::ifstream in(file);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in || std::filesystem::is_directory(file))
    throw DatasetError::missing(file + ": cannot be read as a configuration file; check the path");
  readYamlText(text.str(), file, fields);
}

}  // namespace sidestep
