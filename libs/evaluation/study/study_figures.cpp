// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "figures/gnuplot.h"

namespace sidestep {
namespace {

using Lines = std::vector<const SummaryLine*>;

/// Words of a metric for an axis: mean_error_m -> mean error [m].
std::string axisTitle(const std::string& metric) {
  static const std::map<std::string, std::string> units = {{"m", "m"},     {"m2", "m²"},     {"s", "s"},
                                                           {"deg", "deg"}, {"percent", "%"}, {"ms", "ms"}};
  std::string text = metric, unit;
  const auto last = text.rfind('_');
  if (last != std::string::npos && units.count(text.substr(last + 1)) > 0) {
    unit = units.at(text.substr(last + 1));
    text.resize(last);
  }
  std::replace(text.begin(), text.end(), '_', ' ');
  return unit.empty() ? text : text + " [" + unit + "]";
}

std::string fileName(std::string text) {
  for (char& c : text)
    if (std::string(" /@,+='\"").find(c) != std::string::npos) c = '-';
  return text + ".png";
}

void addNumbers(std::string& out, std::initializer_list<double> values) {
  for (const double v : values) {
    out += std::isfinite(v) ? shortestNumber(v) : "NaN";
    out += ' ';
  }
  out += '\n';
}

/// A logarithmic axis where values differ by more than 30 times and none is zero or less.
bool wantsLogarithm(const Lines& lines) {
  double low = INFINITY, high = 0;
  for (const auto* l : lines) {
    if (!std::isfinite(l->summary.mean)) continue;
    low = std::min(low, l->summary.ci_low);
    high = std::max(high, l->summary.ci_high);
  }
  return low > 0 && high > 30 * low;
}

std::string head(const std::string& title, const std::string& png, int width, int height) {
  return "set terminal pngcairo noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
         " font 'sans,11'\nset encoding utf8\nset output " + gnuplotQuoted(png) + "\nset title " +
         gnuplotQuoted(title) +
         " noenhanced font ',13'\nset border 3 lc rgb '#404040'\nset tics nomirror out\n"
         "set grid ytics back lt 1 lc rgb '#e4e4e4' lw 1\n"
         "set key outside below center horizontal Left reverse noenhanced samplen 2 spacing 1.2 width 3\n";
}

/// Room around the data; a logarithmic axis would else go on to the next power of ten.
std::string rangeAround(const char* axis, double low, double high) {
  return std::string("set ") + axis + "range [" + shortestNumber(low * 0.8) + ":" + shortestNumber(high * 1.25) + "]\n";
}

std::string logarithm(const char* axis) { return std::string("set logscale ") + axis + " 10\n"; }

/// Rows of the table without an axis: a cluster a scenario, a bar an algorithm.
void drawBars(const Study& study, const std::string& metric, const std::string& what, const Lines& lines,
              const std::string& png) {
  std::vector<std::string> scenarios;
  for (const auto* l : lines)
    if (scenarios.empty() || scenarios.back() != l->scenario) scenarios.push_back(l->scenario);
  const auto& algorithms = study.algorithms();
  const double bar = 0.8 / static_cast<double>(algorithms.size());
  std::string blocks, plots, published, tics;
  for (size_t a = 0; a < algorithms.size(); ++a) {
    std::string data;
    for (const auto* l : lines) {
      if (l->algorithm != a) continue;
      const auto cluster =
          static_cast<double>(std::find(scenarios.begin(), scenarios.end(), l->scenario) - scenarios.begin());
      const double x = cluster - 0.4 + (static_cast<double>(a) + 0.5) * bar;
      if (std::isfinite(l->summary.mean))
        addNumbers(data, {x, l->summary.mean, l->summary.ci_low, l->summary.ci_high, bar * 0.92});
      if (l->reference) addNumbers(published, {x, *l->reference, bar * 0.5});
    }
    if (data.empty()) continue;
    const std::string block = "$a" + std::to_string(a);
    blocks += block + " << EOD\n" + data + "EOD\n";
    plots += block + " using 1:2:5 with boxes fs solid 0.85 noborder lc rgb '" + figureColour(a) + "' title " +
             gnuplotQuoted(algorithms[a]) + ", " + block +
             " using 1:3:(0):($4-$3) with vectors heads size screen 0.004,90 lw 1.2 lc rgb '#202020' notitle, ";
  }
  if (!published.empty()) {
    blocks += "$p << EOD\n" + published + "EOD\n";
    plots += "$p using 1:2:3 with xerrorbars ps 0 lw 2.5 lc rgb '#c00000' title 'published', ";
  }
  if (plots.empty()) return;
  plots.resize(plots.size() - 2);
  for (size_t i = 0; i < scenarios.size(); ++i)
    tics += (i > 0 ? ", " : "") + gnuplotQuoted(scenarios[i]) + " " + std::to_string(i);
  const int width = std::clamp(200 + static_cast<int>(scenarios.size() * (40 + 26 * algorithms.size())), 800, 2200);
  const bool many = scenarios.size() > 4;
  runGnuplot(blocks + head(axisTitle(metric) + ", " + what + " and 95 % interval", png, width, many ? 640 : 560) +
                 (wantsLogarithm(lines) ? logarithm("y") : "set yrange [0:*]\n") + "set ylabel " +
                 gnuplotQuoted(axisTitle(metric)) + "\nset xtics noenhanced (" + tics + ")" +
                 (many ? " rotate by -25" : "") + "\nset xrange [-0.6:" + std::to_string(scenarios.size() - 1) +
                 ".6]\nplot " + plots + "\nunset output\n",
             png);
}

/// What the panels of a figure with an axis have in common.
struct CurveRange {
  std::set<double> xs;
  double low = INFINITY, high = 0, least = INFINITY, most = 0;

  CurveRange(const Study& study, const Lines& lines) {
    for (const auto* l : lines) {
      const double x = *study.rows()[l->row].x;
      xs.insert(x);
      low = std::min(low, x), high = std::max(high, x);
      if (l->summary.n > 0 && l->summary.ci_low > 0) least = std::min(least, l->summary.ci_low);
      if (l->summary.n > 0) most = std::max(most, l->summary.ci_high);
    }
  }
  std::string tics() const {
    std::string out;
    for (const double x : xs) out += (out.empty() ? "" : ", ") + shortestNumber(x);
    return out;
  }
};

/// One scenario's curves with their bands, a curve an algorithm. `blocks` takes the data.
std::string curvePanel(const Study& study, size_t scenario, const Lines& lines, std::string& blocks) {
  std::map<size_t, std::string> data;  // by algorithm
  for (const auto* l : lines)
    if (study.rows()[l->row].scenario == scenario && std::isfinite(l->summary.mean))
      addNumbers(data[l->algorithm], {*study.rows()[l->row].x, l->summary.mean, l->summary.ci_low, l->summary.ci_high});
  std::string bands, curves;
  for (const auto& [algorithm, text] : data) {
    const std::string block = "$c" + std::to_string(scenario) + "_" + std::to_string(algorithm);
    blocks += block + " << EOD\n";
    blocks += text + "EOD\n";
    bands += block + " using 1:3:4 with filledcurves fs transparent solid 0.18 noborder lc rgb '" +
             figureColour(algorithm) + "' notitle, ";
    curves += block + " using 1:2 with linespoints lw 2 pt 7 ps 0.7 lc rgb '" + figureColour(algorithm) + "' title " +
              gnuplotQuoted(study.algorithms()[algorithm]) + ", ";
  }
  if (curves.empty()) return "";
  curves.resize(curves.size() - 2);
  return "plot " + bands + curves + "\n";
}

/// Rows on an axis: a panel a scenario of the group, side by side, with the same scales.
void drawCurves(const Study& study, const std::string& metric, const std::string& what, const std::string& group,
                const Lines& lines, const std::string& png) {
  const CurveRange range(study, lines);
  std::vector<std::pair<size_t, std::string>> entries;
  for (const auto* l : lines) {
    const auto& row = study.rows()[l->row];
    if (entries.empty() || entries.back().first != row.scenario)
      entries.emplace_back(row.scenario, row.name.substr(0, row.name.rfind('@')));
  }
  std::string blocks, panels;
  for (const auto& [scenario, name] : entries) {
    const std::string plot = curvePanel(study, scenario, lines, blocks);
    if (!plot.empty()) panels += "set title " + gnuplotQuoted(name) + " noenhanced font ',12'\n" + plot;
  }
  if (panels.empty()) return;
  const int columns = std::min<int>(3, static_cast<int>(entries.size()));
  const int rows = (static_cast<int>(entries.size()) + columns - 1) / columns;
  const std::string title = group + ": " + axisTitle(metric) + ", " + what + " and 95 % band";
  const std::string scales =
      (wantsLogarithm(lines) ? logarithm("y") + rangeAround("y", range.least, range.most)
                             : "set yrange [0:" + shortestNumber(1.05 * std::max(range.most, 1e-9)) + "]\n") +
      (range.low > 0 ? logarithm("x") + rangeAround("x", range.low, range.high) : "");
  runGnuplot(blocks + head(title, png, columns == 1 ? 900 : 520 * columns, 80 + 480 * rows) + scales + "set xtics (" +
                 range.tics() + ")\nset xlabel " + gnuplotQuoted(axisTitle(study.rows()[lines.front()->row].axis)) +
                 " offset 0,0.6\nset ylabel " + gnuplotQuoted(axisTitle(metric)) + "\nset multiplot layout " +
                 std::to_string(rows) + "," + std::to_string(columns) + " title " + gnuplotQuoted(title) +
                 " noenhanced font ',13'\n" + panels + "unset multiplot\nunset output\n",
             png);
}

/// @param what  "mean" or "median"
void drawMetric(const Study& study, const std::string& metric, const std::string& what,
                const std::vector<SummaryLine>& lines, const std::string& folder, std::vector<StudyFigure>& out) {
  Lines plain;
  std::vector<std::pair<std::string, Lines>> groups;
  for (const auto& l : lines) {
    if (l.metric != metric) continue;
    const auto& row = study.rows()[l.row];
    if (!row.x) {
      plain.push_back(&l);
      continue;
    }
    auto it = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.first == row.group; });
    if (it == groups.end()) it = groups.insert(groups.end(), {row.group, {}});
    it->second.push_back(&l);
  }
  const auto finish = [&](const std::string& name, const std::string& title, const auto& draw) {
    const auto file = (std::filesystem::path(folder) / name).string();
    draw(file);
    if (std::filesystem::exists(file)) out.push_back({name, title});
  };
  const std::string name = what == "mean" ? metric : metric + "-" + what;
  const std::string title = axisTitle(metric) + (what == "mean" ? "" : ", " + what);
  if (!plain.empty())
    finish(fileName(name), title, [&](const auto& png) { drawBars(study, metric, what, plain, png); });
  for (const auto& [group, members] : groups)
    finish(fileName(name + "-" + group), group + ": " + title,
           [&, &g = group, &m = members](const auto& png) { drawCurves(study, metric, what, g, m, png); });
}

/// The first run of each row with each algorithm of `pictures`, and all of them over time.
void drawRuns(const Study& study, const std::string& folder, std::vector<StudyFigure>& out) {
  const auto& all = study.algorithms();
  const auto path = [&](const std::string& file) { return (std::filesystem::path(folder) / file).string(); };
  for (const auto& name : study.pictures) {
    const auto algorithm = static_cast<size_t>(std::find(all.begin(), all.end(), name) - all.begin());
    for (size_t row = 0; row < study.rows().size(); ++row) {
      const std::string title = study.rows()[row].name + ", " + name + ", run 0";
      const std::string file = fileName("run-" + study.rows()[row].name + "-" + name);
      if (study.runner().draw(study.place(row, algorithm, 0), title, path(file))) out.push_back({file, title});
    }
  }
  for (size_t row = 0; row < study.rows().size(); ++row) {
    std::vector<StudyPlace> places;
    for (const auto& name : study.pictures)
      places.push_back(study.place(row, static_cast<size_t>(std::find(all.begin(), all.end(), name) - all.begin()), 0));
    const std::string title = study.rows()[row].name + ", run 0", file = fileName("time-" + study.rows()[row].name);
    if (!places.empty() && study.runner().drawTogether(places, study.pictures, title, path(file)))
      out.push_back({file, title + ", over time"});
  }
}

}  // namespace

std::vector<StudyFigure> drawStudy(const Study& study, const std::vector<SummaryLine>& lines,
                                   const std::vector<SummaryLine>& medians, const std::string& folder) {
  std::vector<StudyFigure> out;
  for (const auto& metric : study.figures) drawMetric(study, metric, "mean", lines, folder, out);
  for (const auto& metric : study.medians) drawMetric(study, metric, "median", medians, folder, out);
  drawRuns(study, folder, out);
  return out;
}

}  // namespace sidestep
