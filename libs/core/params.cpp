// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "core/params.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <numeric>
#include <sstream>

#include "core/errors.h"

namespace sidestep {
namespace {

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

std::string rangeText(Range r) {
  const bool low = std::isfinite(r.low), high = std::isfinite(r.high);
  if (low && high) return shortestNumber(r.low) + " .. " + shortestNumber(r.high);
  if (low) return ">= " + shortestNumber(r.low);
  if (high) return "<= " + shortestNumber(r.high);
  return "";
}

std::string joined(const std::vector<std::string>& words, const std::string& glue) {
  std::string out;
  for (const auto& w : words) out += (out.empty() ? "" : glue) + w;
  return out;
}

std::string inQuotes(const std::string& s) {
  std::string out = "\"";
  for (char c : s) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";  // a line break in quotes would read back as a space
    else
      out += c;
  }
  return out + "\"";
}

bool isDegrees(const std::string& key) { return key.size() > 4 && key.ends_with("_deg"); }

/// Writes the commented YAML.
class YamlWriter final : public ParamVisitor {
 public:
  void number(const std::string& key, double& v, Range r, const std::string& unit, const std::string& m) override {
    line(key, shortestNumber(v), note(m, unit, rangeText(r)));
  }
  void integer(const std::string& key, int& v, Range r, const std::string& m) override {
    line(key, std::to_string(v), note(m, "", rangeText(r)));
  }
  void flag(const std::string& key, bool& v, const std::string& m) override { line(key, v ? "true" : "false", m); }
  void choice(const std::string& key, std::string& v, const std::vector<std::string>& words,
              const std::string& m) override {
    line(key, v, note(m, "", joined(words, " | ")));
  }
  void text(const std::string& key, std::string& v, const std::string& m) override { line(key, inQuotes(v), m); }
  void texts(const std::string& key, std::vector<std::string>& v, const std::string& m) override {
    std::vector<std::string> q;
    for (const auto& s : v) q.push_back(inQuotes(s));
    line(key, std::string("[").append(joined(q, ", ")).append("]"), m);
  }
  void table(const std::string& key, const std::vector<std::string>& columns, Table& rows,
             const std::string& m) override {
    const std::string about = note(m, "", "rows of " + joined(columns, ", "));
    if (rows.empty()) return line(key, "[]", about);
    out_ << indent_ << key << ":  # " << about << "\n";
    for (const auto& row : rows) {
      std::vector<std::string> cells;
      for (size_t i = 0; i < columns.size(); ++i) {
        const double value = isDegrees(columns[i]) ? row[i] * 180.0 / M_PI : row[i];
        cells.push_back(columns[i] + ": " + shortestNumber(value));
      }
      out_ << indent_ << "  - {" << joined(cells, ", ") << "}\n";
    }
  }
  void section(const std::string& key, const std::string& m, const Visit& fields) override {
    out_ << indent_ << "# " << m << "\n" << indent_ << key << ":\n";
    indent_ += "  ";
    fields(*this);
    indent_.resize(indent_.size() - 2);
  }
  void groups(const std::string& key, std::vector<std::string>& names, const std::string& m,
              const std::function<void(const std::string&, ParamVisitor&)>& fields) override {
    if (names.empty()) return line(key, "{}", m);
    section(key, m, [&](ParamVisitor& v) {
      for (const auto& name : names) {
        out_ << indent_ << name << ":\n";
        indent_ += "  ";
        fields(name, v);
        indent_.resize(indent_.size() - 2);
      }
    });
  }
  void overlay(const std::string& key, std::string& yaml, const std::string& m) override {
    if (yaml.find_first_not_of(" \n") == std::string::npos) return line(key, "{}", m);
    out_ << indent_ << key << ":  # " << m << "\n";
    std::istringstream lines(yaml);
    for (std::string text; std::getline(lines, text);)
      if (!text.empty()) out_ << indent_ << "  " << text << "\n";
  }
  std::string str() const { return out_.str(); }

 private:
  static std::string note(const std::string& meaning, const std::string& unit, const std::string& allowed) {
    std::string out = meaning;
    if (!unit.empty()) out += " [" + unit + "]";
    if (!allowed.empty()) out += "; " + allowed;
    return out;
  }
  void line(const std::string& key, const std::string& value, const std::string& about) {
    out_ << indent_ << key << ": " << value << "  # " << about << "\n";
  }
  std::ostringstream out_;
  std::string indent_;
};

/// Writes the Markdown table of doc/parameters.md.
class MarkdownWriter final : public ParamVisitor {
 public:
  void number(const std::string& key, double& v, Range r, const std::string& unit, const std::string& m) override {
    row(key, shortestNumber(v), unit, rangeText(r), m);
  }
  void integer(const std::string& key, int& v, Range r, const std::string& m) override {
    row(key, std::to_string(v), "", rangeText(r), m);
  }
  void flag(const std::string& key, bool& v, const std::string& m) override {
    row(key, v ? "true" : "false", "", "true, false", m);
  }
  void choice(const std::string& key, std::string& v, const std::vector<std::string>& words,
              const std::string& m) override {
    row(key, v, "", joined(words, ", "), m);
  }
  void text(const std::string& key, std::string& v, const std::string& m) override { row(key, v, "", "", m); }
  void texts(const std::string& key, std::vector<std::string>& v, const std::string& m) override {
    row(key, joined(v, ", "), "", "list", m);
  }
  void table(const std::string& key, const std::vector<std::string>& columns, Table&, const std::string& m) override {
    row(key, "", "", "rows of " + joined(columns, ", "), m);
  }
  void section(const std::string& key, const std::string&, const Visit& fields) override {
    const std::string outer = prefix_;
    prefix_ += key + ".";
    fields(*this);
    prefix_ = outer;
  }
  void groups(const std::string& key, std::vector<std::string>&, const std::string& m,
              const std::function<void(const std::string&, ParamVisitor&)>& fields) override {
    row(key, "", "", "groups by name", m);
    section(key + ".NAME", m, [&](ParamVisitor& v) { fields("", v); });
  }
  void overlay(const std::string& key, std::string&, const std::string& m) override { row(key, "", "", "a group", m); }
  std::string str() const {
    return "| key | default | unit | allowed | meaning |\n|---|---|---|---|---|\n" + out_.str();
  }

 private:
  void row(const std::string& key, const std::string& value, const std::string& unit, const std::string& allowed,
           const std::string& meaning) {
    out_ << "| `" << prefix_ << key << "` | " << value << " | " << unit << " | " << allowed << " | " << meaning
         << " |\n";
  }
  std::ostringstream out_;
  std::string prefix_;
};

}  // namespace

std::string nearestWord(const std::string& word, const std::vector<std::string>& known) {
  std::string best;
  size_t best_distance = std::max<size_t>(2, word.size() / 3) + 1;
  for (const auto& k : known) {
    const size_t d = editDistance(word, k);
    if (d < best_distance) {
      best_distance = d;
      best = k;
    }
  }
  return best;
}

std::string shortestNumber(double value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string writeYaml(const Visit& fields) {
  YamlWriter w;
  fields(w);
  return w.str();
}

std::string markdownTable(const Visit& fields) {
  MarkdownWriter w;
  fields(w);
  return w.str();
}

}  // namespace sidestep
