// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sidestep {

/// Allowed values of a number, both ends included.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Rows of numbers, for example one beacon a row.
using Table = std::vector<std::vector<double>>;

/// What a parameter struct shows its fields to. Each struct has one `void visit(ParamVisitor&)` that names each field
/// once, with key, range, unit and meaning; the strict reader, the commented default file and the tables in doc/ all
/// come from that one place. In-memory values are SI and radians; `angle` reads and writes degrees.
class ParamVisitor {
 public:
  virtual ~ParamVisitor() = default;
  virtual void number(const std::string& key, double& value, Range range, const std::string& unit,
                      const std::string& meaning) = 0;
  virtual void integer(const std::string& key, int& value, Range range, const std::string& meaning) = 0;
  virtual void flag(const std::string& key, bool& value, const std::string& meaning) = 0;
  /// One of a few words.
  virtual void choice(const std::string& key, std::string& value, const std::vector<std::string>& words,
                      const std::string& meaning) = 0;
  virtual void text(const std::string& key, std::string& value, const std::string& meaning) = 0;
  virtual void texts(const std::string& key, std::vector<std::string>& value, const std::string& meaning) = 0;
  /// A list of rows, each a map with exactly `columns` as keys; a column whose name ends in _deg is radians in memory.
  virtual void table(const std::string& key, const std::vector<std::string>& columns, Table& rows,
                     const std::string& meaning) = 0;
  /// A nested group.
  virtual void section(const std::string& key, const std::string& meaning,
                       const std::function<void(ParamVisitor&)>& fields) = 0;
  /// Groups under keys that the file's author chooses. A reader makes `names` those of the file, in its order, if it has
  /// `key`; then each visitor shows the fields of each name.
  virtual void groups(const std::string& key, std::vector<std::string>& names, const std::string& meaning,
                      const std::function<void(const std::string& name, ParamVisitor&)>& fields) = 0;
  /// A group kept as YAML, to be laid over other parameters later (`readYamlText`). As read it starts with as many line
  /// breaks as lines stood before it, so that errors name the right line.
  virtual void overlay(const std::string& key, std::string& yaml, const std::string& meaning) = 0;

  /// Radians in memory, degrees in the file; `key` must end in `_deg`, `range_deg` is in degrees.
  void angle(const std::string& key, double& radians, Range range_deg, const std::string& meaning) {
    double degrees = radians * 180.0 / M_PI;
    const double before = degrees;
    number(key, degrees, range_deg, "deg", meaning);
    if (degrees != before) radians = degrees * M_PI / 180.0;
  }
};

/// A struct's fields, as a function that shows them to a visitor.
using Visit = std::function<void(ParamVisitor&)>;

/// The fields of a struct that must not change, for the writers: they are shown a copy.
template <class Params>
Visit fieldsOf(const Params& params) {
  return [copy = params](ParamVisitor& v) mutable { copy.visit(v); };
}

/// Reads `file` into the fields; keys that the file leaves out keep their defaults.
/// @throws ConfigError "file:line: key = value ..., allowed ..., did you mean ...?" for an unknown or repeated key, a
///         wrong type, a value that is not finite or out of range; DatasetError if the file cannot be read.
void readYaml(const std::string& file, const Visit& fields);
/// The same from text; `name` stands for the file in messages.
void readYamlText(const std::string& text, const std::string& name, const Visit& fields);

/// All fields with their present values as YAML, each with its meaning, unit and range as a comment; reads back equal.
std::string writeYaml(const Visit& fields);

/// The fields as a Markdown table: key, default, unit, range, meaning.
std::string markdownTable(const Visit& fields);

/// The one of `known` that is nearest to `word` (edit distance), or "" if none is near.
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);

/// A number as text that reads back to the same bits, in the shortest form.
std::string shortestNumber(double value);

}  // namespace sidestep
