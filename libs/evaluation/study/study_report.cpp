// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_report.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace sidestep {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:1150px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0;font-variant-numeric:tabular-nums}"
    "th,td{padding:.25em .7em;border-bottom:1px solid #ddd;text-align:right;vertical-align:top}"
    "th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #888}"
    "td small{color:#666;display:block}td "
    "small.pub{color:#b00000}.good{color:#00704d}.bad{color:#b00000;font-weight:bold}"
    "img{max-width:100%;border:1px solid #eee;margin:.5em 0}pre{background:#f6f6f6;padding:.8em;overflow-x:auto}"
    "td.text{text-align:left}";

std::string shown(double value, int digits = 4, bool sign = false) {
  if (!std::isfinite(value)) return "&ndash;";
  std::array<char, 40> text;
  if (sign)
    std::snprintf(text.data(), text.size(), "%+.*g", digits, value);
  else
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

void add(std::string& out, std::initializer_list<std::string> parts) {
  for (const auto& p : parts) out += p;
}

std::string cell(const SummaryLine& l) {
  std::string out = "<td><b>" + shown(l.summary.mean) + "</b><small>" + shown(l.summary.ci_low) + " &hellip; " +
                    shown(l.summary.ci_high) + "</small>";
  if (l.reference) add(out, {"<small class=\"pub\">published ", shown(*l.reference), "</small>"});
  if (l.difference)
    add(out, {"<small>&Delta; ", shown(*l.difference, 3, true), ", p ", shown(l.p_value.value_or(NAN), 2), "</small>"});
  return out + "</td>";
}

std::string metricTable(const Study& study, const std::vector<SummaryLine>& lines, const std::string& metric) {
  std::string out = "<h3>" + htmlEscaped(metric) + "</h3>\n<table><thead><tr><th>scenario</th>";
  for (const auto& a : study.algorithms()) add(out, {"<th>", htmlEscaped(a), "</th>"});
  out += "</tr></thead><tbody>\n";
  size_t open = study.rows().size();
  for (const auto& l : lines) {
    if (l.metric != metric) continue;
    if (l.row != open) {
      if (open != study.rows().size()) out += "</tr>\n";
      add(out, {"<tr><td>", htmlEscaped(l.scenario), "</td>"});
      open = l.row;
    }
    out += cell(l);
  }
  return out + "</tr></tbody></table>\n";
}

std::string expectationTable(const std::vector<ExpectationResult>& expectations) {
  if (expectations.empty()) return "";
  std::string out =
      "<h2>Expectations</h2>\n<table><thead><tr><th>expected</th><th>seen</th><th></th></tr></thead><tbody>\n";
  for (const auto& e : expectations)
    add(out, {"<tr><td><code>", htmlEscaped(e.text), "</code></td><td class=\"text\">", htmlEscaped(e.seen),
              "</td><td class=\"", e.met ? "good\">met" : "bad\">missed", "</td></tr>\n"});
  return out + "</tbody></table>\n";
}

std::string figureHtml(const StudyFigure& figure, const std::string& folder) {
  if (!figure.failure.empty())
    return "<h3>" + htmlEscaped(figure.title) +
           "</h3>\n<p class=\"bad\">could not be drawn: " + htmlEscaped(figure.failure) + "</p>\n";
  std::ifstream in(std::filesystem::path(folder) / figure.file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::string out = "<h3>" + htmlEscaped(figure.title) + "</h3>\n<img alt=\"" + htmlEscaped(figure.title) +
                    "\" src=\"data:image/png;base64,";
  out += base64(bytes);
  return out + "\">\n";
}

std::string runsLine(const ReportFacts& f) {
  std::string out = "<p>" + std::to_string(f.runs_done) + " of " + std::to_string(f.runs_all) + " runs";
  if (f.runs_failed > 0)
    out += ", <span class=\"bad\">" + std::to_string(f.runs_failed) + " of them came to nothing</span>";
  out += ".</p>\n";
  if (f.failures.empty()) return out;
  out += "<ul>";
  for (const auto& line : f.failures) add(out, {"<li>", htmlEscaped(line), "</li>"});
  return out + "</ul>\n";
}

}  // namespace

std::string htmlEscaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string base64(const std::string& bytes) {
  static const char* const kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t word = 0;
    for (size_t k = 0; k < 3; ++k)
      word = (word << 8) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : kLetters[(word >> (18 - 6 * k)) & 63];
  }
  return out;
}

std::string reportHtml(const Study& study, const std::vector<SummaryLine>& lines,
                       const std::vector<ExpectationResult>& expectations, const std::vector<StudyFigure>& figures,
                       const std::string& folder, const ReportFacts& facts) {
  const std::string title = htmlEscaped(study.title.empty() ? "Study" : study.title);
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
                    "</title>\n<style>" + kStyle + "</style></head><body>\n<h1>" + title + "</h1>\n";
  if (!study.about.empty()) add(out, {"<p>", htmlEscaped(study.about), "</p>\n"});
  out += runsLine(facts) + expectationTable(expectations);
  out +=
      "<h2>Tables</h2>\n<p>Bold: mean over the runs; below it the 95 % interval of that mean (bootstrap), the "
      "published "
      "number, and the mean difference";
  add(out, {study.baseline.empty() ? " from the baseline" : " from " + htmlEscaped(study.baseline),
            " over the same runs with its p-value (sign flips).</p>\n"});
  for (const auto& metric : study.reportedMetrics()) out += metricTable(study, lines, metric);
  out += facts.more_tables;
  if (!figures.empty()) out += "<h2>Figures</h2>\n";
  for (const auto& f : figures) out += figureHtml(f, folder);
  add(out, {"<h2>Command</h2>\n<pre>", htmlEscaped(facts.command), "</pre>\n<h2>Parameters</h2>\n",
            "<details><summary>effective.yaml</summary><pre>", htmlEscaped(facts.parameters),
            "</pre></details>\n</body></html>\n"});
  return out;
}

}  // namespace sidestep
