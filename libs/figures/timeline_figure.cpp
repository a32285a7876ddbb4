// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/timeline_figure.h"

#include <algorithm>

#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

std::string block(const TimelineFigure::Run& run, size_t number) {
  std::string out = "$r" + std::to_string(number) + " << EOD\n";
  for (const auto& s : run.samples) {
    for (const double value : {s.time_s, s.delta_min, s.v, s.w, s.collision_index}) out += shortestNumber(value) + " ";
    out += "\n";
  }
  return out + "EOD\n";
}

/// One quantity of all runs.
std::string panel(const TimelineFigure& figure, const std::string& settings, int column, bool with_key) {
  std::string out = settings + "plot ";
  for (size_t i = 0; i < figure.runs.size(); ++i)
    out += (i > 0 ? ", " : "") + ("$r" + std::to_string(i)) + " using 1:" + std::to_string(column) +
           " with lines lw 2 lc rgb '" + figureColour(i) + "' " +
           (with_key ? "title " + gnuplotQuoted(figure.runs[i].name) : "notitle");
  return out + "\n";
}

}  // namespace

void drawTimeline(const TimelineFigure& figure, const std::string& png_file) {
  double end_s = 0.1;
  std::string script;
  for (size_t i = 0; i < figure.runs.size(); ++i) {
    script += block(figure.runs[i], i);
    if (!figure.runs[i].samples.empty()) end_s = std::max(end_s, figure.runs[i].samples.back().time_s);
  }
  const bool several = figure.runs.size() > 1;
  script +=
      "set terminal pngcairo noenhanced size 1000,1150 font 'sans,12'\nset encoding utf8\nset output " +
      gnuplotQuoted(png_file) + "\nset border 3 lc rgb '#404040'\nset tics nomirror out\n" +
      "set grid back lt 1 lc rgb '#e8e8e8'\nset lmargin 10\nset rmargin 3\nset xrange [0:" + shortestNumber(end_s) +
      "]\nset multiplot layout 4,1 title " + gnuplotQuoted(figure.title) +
      " noenhanced\nset key outside above center horizontal noenhanced samplen 2\n";
  script += panel(figure, "set ylabel 'δ_min (4.6)'\nset yrange [0:1.05]\n", 2, several);
  script += panel(figure,
                  "unset key\nset ylabel 'collision index (4.11)'\nset arrow 1 from graph 0, first " +
                      shortestNumber(figure.index_threshold) + " to graph 1, first " +
                      shortestNumber(figure.index_threshold) + " nohead dt 2 lw 1.5 lc rgb '#d62728'\n",
                  5, false);
  script += panel(figure, "unset arrow 1\nset ylabel 'speed [m/s]'\nset yrange [*<0:*]\n", 3, false);
  script += panel(figure, "set ylabel 'turn rate [rad/s]'\nset xlabel 'time [s]'\nset yrange [*:*]\n", 4, false);
  if (!figure.runs.empty()) runGnuplot(script + "unset multiplot\nunset output\n", png_file);
}

}  // namespace sidestep
