// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/band_figure.h"

#include <algorithm>
#include <cstdio>

#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

std::string row(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f %.4f\n", x, y);
  return text;
}

std::string block(const std::string& name, const std::string& rows) {
  return name + " << EOD\n" + (rows.empty() ? row(0, 0) : rows) + "EOD\n";
}

std::string rowsOf(const std::vector<BandFigure::Line>& lines) {
  std::string out;
  for (const auto& line : lines) {
    for (const auto& p : line) out += row(p.x, p.y);
    out += "\n";
  }
  return out;
}

std::string plotOf(const std::string& title, const std::string& n, double radius_m) {
  return "set title " + gnuplotQuoted(title) + "\nplot $o" + n + " u 1:2:(" + shortestNumber(radius_m) +
         ") w circles lc rgb '#bbbbbb', $a" + n + " w lines lc rgb '#777777', $b" + n +
         " w linespoints pt 7 ps 0.4 lc rgb '#cc0000'\n";
}

}  // namespace

void drawBands(const BandFigure& figure, const std::string& png_file) {
  std::string data, plots;
  for (size_t i = 0; i < figure.panels.size(); ++i) {
    const BandFigure::Panel& panel = figure.panels[i];
    const std::string n = std::to_string(i);
    std::string obstacles;
    for (const auto& o : panel.obstacles) obstacles += row(o.x, o.y);
    data += block("$o" + n, obstacles) + block("$a" + n, rowsOf(panel.others)) + block("$b" + n, rowsOf(panel.chosen));
    plots += plotOf(panel.title, n, figure.radius_m);
  }
  const int count = static_cast<int>(figure.panels.size());
  const int columns = count <= 4 ? std::clamp(count, 1, 2) : 3, rows = std::max(1, (count + columns - 1) / columns);
  runGnuplot("set terminal pngcairo size " + std::to_string(500 * columns) + "," + std::to_string(400 * rows) +
                 "\nset output " + gnuplotQuoted(png_file) + "\n" + data + "set multiplot layout " +
                 std::to_string(rows) + "," + std::to_string(columns) +
                 "\nset size ratio -1\nunset key\nset xrange [-0.8:8.8]\nset yrange [-4.8:4.8]\n" + plots +
                 "unset multiplot\n",
             png_file);
}

}  // namespace sidestep
