// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/consistency_figure.h"

#include <algorithm>
#include <cmath>

#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

constexpr size_t kMostPoints = 2000, kMostBlocks = 40;

/// One line of numbers for gnuplot.
void addRow(std::string& out, std::initializer_list<double> values) {
  for (const double v : values) {
    out += std::isfinite(v) ? shortestNumber(v) : "NaN";
    out += ' ';
  }
  out += '\n';
}

/// What gnuplot reads of one panel.
struct Rows {
  std::string accepted, refused;  ///< time, value
  std::string means;              ///< time, mean, low, high
  double low = 0.05, high = 20;   ///< of the axis

  Rows(const ConsistencyFigure::Panel& panel, double start_s) {
    for (const auto& p : panel.values) {
      addRow(p.accepted ? accepted : refused, {p.time_s - start_s, p.value});
      see(p.value);
    }
    for (const auto& m : panel.means) {
      addRow(means, {m.time_s - start_s, m.mean, std::max(m.low, 1e-3), m.high});
      see(m.mean);
      see(m.high);
    }
  }
  void see(double value) {
    if (value > 0) low = std::min(low, std::max(value, 0.01)), high = std::max(high, std::min(value, 1e4));
  }
};

std::string blockOf(const std::string& name, const std::string& rows) { return name + " << EOD\n" + rows + "EOD\n"; }

std::string panelScript(const ConsistencyFigure::Panel& panel, const Rows& p, size_t number, bool last) {
  const std::string a = "$a" + std::to_string(number), r = "$r" + std::to_string(number),
                    m = "$m" + std::to_string(number);
  std::string out, plots;
  if (!p.means.empty())
    plots +=
        m + " using 1:3:4 with filledcurves fs solid 0.25 noborder lc rgb '#0072b2' title '95 % band of the means', ";
  if (!p.accepted.empty()) plots += a + " using 1:2 with points pt 7 ps 0.3 lc rgb '#a8a8a8' title 'single values', ";
  if (!p.refused.empty()) plots += r + " using 1:2 with points pt 2 ps 0.6 lc rgb '#d55e00' title 'refused', ";
  plots += shortestNumber(panel.expected) + " with lines lw 1.5 dt (8,6) lc rgb '#000000' title 'expected'";
  if (!p.means.empty())
    plots += ", " + m + " using 1:2 with linespoints lw 2 pt 7 ps 0.6 lc rgb '#0072b2' title 'means of blocks'";
  out += "set title " + gnuplotQuoted(panel.title) + " noenhanced font ',12'\n";
  out += "set yrange [" + shortestNumber(0.7 * p.low) + ":" + shortestNumber(1.5 * p.high) + "]\n";
  out += last ? "set xlabel 'time [s]'\n" : "unset xlabel\n";
  return out + "plot " + plots + "\n";
}

}  // namespace

void NisTrack::add(double time_s, double nis, int dof, bool accepted) {
  dof_ = dof;
  if (seen_++ % stride_ == 0) points_.push_back({time_s, nis, accepted});
  if (points_.size() >= kMostPoints) {
    for (size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
    points_.resize((points_.size() + 1) / 2);
    stride_ *= 2;
  }
  if (!accepted) return;
  if (blocks_.empty() || blocks_.back().count >= block_size_) blocks_.push_back({time_s, time_s, 0, 0});
  auto& b = blocks_.back();
  b.to_s = time_s;
  b.sum += nis;
  ++b.count;
  if (blocks_.size() <= kMostBlocks) return;
  const Block newest = blocks_.back();
  blocks_.pop_back();
  for (size_t i = 0; 2 * i + 1 < blocks_.size(); ++i) {
    const auto &x = blocks_[2 * i], &y = blocks_[2 * i + 1];
    blocks_[i] = {x.from_s, y.to_s, x.sum + y.sum, x.count + y.count};
  }
  blocks_.resize(kMostBlocks / 2);
  blocks_.push_back(newest);
  block_size_ *= 2;
}

bool drawConsistency(const ConsistencyFigure& figure, const std::string& png_file) {
  const auto& panels = figure.panels;
  if (panels.empty()) return false;
  const std::string count = std::to_string(panels.size());
  std::vector<Rows> rows;
  std::string script;
  for (size_t i = 0; i < panels.size(); ++i) {
    const Rows& r = rows.emplace_back(panels[i], figure.start_s);
    script += blockOf("$a" + std::to_string(i), r.accepted) + blockOf("$r" + std::to_string(i), r.refused) +
              blockOf("$m" + std::to_string(i), r.means);
  }
  script +=
      "set terminal pngcairo noenhanced size 1100," + std::to_string(60 + 290 * panels.size()) +
      " font 'sans,11'\nset encoding utf8\nset output " + gnuplotQuoted(png_file) + "\nset multiplot layout " + count +
      ",1 title " + gnuplotQuoted(figure.title) +
      " noenhanced font ',14'\nset border 3 lc rgb '#404040'\nset tics nomirror out\nset logscale y 10\nset lmargin 9\n"
      "set grid ytics back lt 1 lc rgb '#e4e4e4' lw 1\nset format y '%g'\n"
      "set key outside right top vertical Left reverse noenhanced samplen 2 spacing 1.2 width 1\n";
  for (size_t i = 0; i < panels.size(); ++i) script += panelScript(panels[i], rows[i], i, i + 1 == panels.size());
  runGnuplot(script + "unset multiplot\nunset output\n", png_file);
  return true;
}

}  // namespace sidestep
