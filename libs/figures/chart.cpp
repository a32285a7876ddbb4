// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/chart.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

/// Past this gnuplot's own arithmetic with ranges runs over.
constexpr double kLargest = 1e100;

bool isShown(const ChartValue& v) { return std::isfinite(v.value) && std::abs(v.value) < kLargest; }

void addNumbers(std::string& out, std::initializer_list<double> values) {
  for (const double v : values) {
    out += std::isfinite(v) ? shortestNumber(std::clamp(v, -kLargest, kLargest)) : "NaN";
    out += ' ';
  }
  out += '\n';
}

/// What an axis of values must hold.
struct Extent {
  double low = INFINITY, high = 0;    ///< of the intervals
  double least = INFINITY, most = 0;  ///< of the intervals above 0

  void add(const ChartValue& v) {
    if (!isShown(v)) return;
    add(v.low);
    add(v.high);
    if (v.low > 0) least = std::min(least, v.low);
    most = std::max(most, std::min(v.high, kLargest));
  }
  void add(double value) {
    if (std::isfinite(value) && std::abs(value) < kLargest) low = std::min(low, value), high = std::max(high, value);
  }
  /// Values differ by more than 30 times and none is zero or less.
  bool wantsLogarithm() const { return low > 0 && high > 30 * low; }
  bool hasNegative() const { return low < 0; }
};

std::string head(const std::string& title, const std::string& png, int width, int height) {
  return "set terminal pngcairo noenhanced size " + std::to_string(width) + "," + std::to_string(height) +
         " font 'sans,11'\nset encoding utf8\nset output " + gnuplotQuoted(png) + "\nset title " +
         gnuplotQuoted(title) +
         " noenhanced font ',13'\nset border 3 lc rgb '#404040'\nset tics nomirror out\n"
         "set grid ytics back lt 1 lc rgb '#e4e4e4' lw 1\n"
         "set key outside below center horizontal Left reverse noenhanced samplen 2 spacing 1.2 width 3\n";
}

std::string range(const char* axis, const std::string& low, const std::string& high) {
  return std::string("set ") + axis + "range [" + low + ":" + high + "]\n";
}

/// Room around the data; a logarithmic axis would else go on to the next power of ten.
std::string rangeAround(const char* axis, double low, double high) {
  return range(axis, shortestNumber(low * 0.8), shortestNumber(high * 1.25));
}

std::string logarithm(const char* axis) { return std::string("set logscale ") + axis + " 10\n"; }

/// Below zero there is as much room as above; the line at 0 is drawn.
std::string rangeBelowZero(const Extent& y) {
  const double room = 0.05 * (y.high - y.low);
  return range("y", shortestNumber(y.low - room), shortestNumber(y.high > 0 ? y.high + room : 0)) +
         "set xzeroaxis lt 1 lc rgb '#404040'\n";
}

std::string barRange(const Extent& y) {
  if (y.hasNegative()) return rangeBelowZero(y);
  return y.wantsLogarithm() ? logarithm("y") : "set yrange [0:*]\n";
}

std::string curveRange(const Extent& y) {
  if (y.hasNegative()) return rangeBelowZero(y);
  if (y.wantsLogarithm()) return logarithm("y") + rangeAround("y", y.least, y.most);
  return range("y", "0", shortestNumber(1.05 * std::max(y.most, 1e-9)));
}

std::string shownPoints(const CurveChart::Curve& curve) {
  std::string data;
  for (const auto& p : curve.points)
    if (isShown(p.value)) addNumbers(data, {p.x, p.value.value, p.value.low, p.value.high});
  return data;
}

/// The plot of one panel, a curve after the other; `blocks` takes the data.
std::string curvePanel(const CurveChart::Panel& panel, const std::string& number, std::string& blocks) {
  std::string bands, curves;
  for (size_t i = 0; i < panel.curves.size(); ++i) {
    const auto& curve = panel.curves[i];
    const std::string data = shownPoints(curve);
    if (data.empty()) continue;
    const std::string block = "$c" + number + "_" + std::to_string(i), colour = figureColour(curve.colour);
    blocks += block + " << EOD\n" + data + "EOD\n";
    bands +=
        block + " using 1:3:4 with filledcurves fs transparent solid 0.18 noborder lc rgb '" + colour + "' notitle, ";
    curves += block + " using 1:2 with linespoints lw 2 pt 7 ps 0.7 lc rgb '" + colour + "' title " +
              gnuplotQuoted(curve.name) + ", ";
  }
  if (curves.empty()) return "";
  curves.resize(curves.size() - 2);
  return "set title " + gnuplotQuoted(panel.title) + " noenhanced font ',12'\nplot " + bands + curves + "\n";
}

/// The values of the x axis, as tics.
struct Axis {
  std::set<double> xs;
  Extent y;

  explicit Axis(const CurveChart& chart) {
    for (const auto& panel : chart.panels)
      for (const auto& curve : panel.curves)
        for (const auto& p : curve.points) {
          xs.insert(p.x);
          y.add(p.value);
        }
  }
  std::string range() const {
    return !xs.empty() && *xs.begin() > 0 ? logarithm("x") + rangeAround("x", *xs.begin(), *xs.rbegin()) : "";
  }
  std::string tics() const {
    std::string out;
    for (const double x : xs) out += (out.empty() ? "" : ", ") + shortestNumber(x);
    return out;
  }
};

/// Bars of one series, and its published numbers; `extent` sees all of them.
std::string barRows(const BarChart& chart, size_t series, double width, std::string& published, Extent& extent) {
  std::string data;
  for (const auto& bar : chart.series[series].bars) {
    const double x = static_cast<double>(bar.cluster) - 0.4 + (static_cast<double>(series) + 0.5) * width;
    extent.add(bar.value);
    if (isShown(bar.value)) addNumbers(data, {x, bar.value.value, bar.value.low, bar.value.high, width * 0.92});
    if (!bar.published) continue;
    addNumbers(published, {x, *bar.published, width * 0.5});
    if (*bar.published < 0) extent.add(*bar.published);
  }
  return data;
}

}  // namespace

bool drawBars(const BarChart& chart, const std::string& png_file) {
  const double width = 0.8 / static_cast<double>(chart.series.size());
  std::string blocks, plots, published, tics;
  Extent extent;
  for (size_t i = 0; i < chart.series.size(); ++i) {
    const std::string data = barRows(chart, i, width, published, extent);
    if (data.empty()) continue;
    const std::string block = "$a" + std::to_string(i);
    blocks += block + " << EOD\n" + data + "EOD\n";
    plots += block + " using 1:2:5 with boxes fs solid 0.85 noborder lc rgb '" + figureColour(i) + "' title " +
             gnuplotQuoted(chart.series[i].name) + ", " + block +
             " using 1:3:(0):($4-$3) with vectors heads size screen 0.004,90 lw 1.2 lc rgb '#202020' notitle, ";
  }
  if (!published.empty()) {
    blocks += "$p << EOD\n" + published + "EOD\n";
    plots += "$p using 1:2:3 with xerrorbars ps 0 lw 2.5 lc rgb '#c00000' title 'published', ";
  }
  if (plots.empty()) return false;
  plots.resize(plots.size() - 2);
  const size_t n = chart.clusters.size();
  for (size_t i = 0; i < n; ++i)
    tics += (i > 0 ? ", " : "") + gnuplotQuoted(chart.clusters[i]) + " " + std::to_string(i);
  const int pixels = std::clamp(200 + static_cast<int>(n * (40 + 26 * chart.series.size())), 800, 2200);
  runGnuplot(blocks + head(chart.title, png_file, pixels, n > 4 ? 640 : 560) + barRange(extent) + "set ylabel " +
                 gnuplotQuoted(chart.value_label) + "\nset xtics noenhanced (" + tics + ")" +
                 (n > 4 ? " rotate by -25" : "") + "\nset xrange [-0.6:" + std::to_string(n - 1) + ".6]\nplot " +
                 plots + "\nunset output\n",
             png_file);
  return true;
}

bool drawCurves(const CurveChart& chart, const std::string& png_file) {
  const Axis axis(chart);
  std::string blocks, panels;
  for (size_t i = 0; i < chart.panels.size(); ++i) panels += curvePanel(chart.panels[i], std::to_string(i), blocks);
  if (panels.empty()) return false;
  const int count = static_cast<int>(chart.panels.size()), columns = std::min(3, count);
  const int rows = (count + columns - 1) / columns;
  runGnuplot(blocks + head(chart.title, png_file, columns == 1 ? 900 : 520 * columns, 80 + 480 * rows) +
                 curveRange(axis.y) + axis.range() + "set xtics (" + axis.tics() + ")\nset xlabel " +
                 gnuplotQuoted(chart.x_label) + " offset 0,0.6\nset ylabel " + gnuplotQuoted(chart.value_label) +
                 "\nset multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + " title " +
                 gnuplotQuoted(chart.title) + " noenhanced font ',13'\n" + panels + "unset multiplot\nunset output\n",
             png_file);
  return true;
}

}  // namespace sidestep
