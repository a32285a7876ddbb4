// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/snapshot_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

constexpr double kAround_m = 1;  ///< shown beyond what moves

std::string row(const TPoint2D& p) { return shortestNumber(p.x) + " " + shortestNumber(p.y); }

/// Corners of all that is to be seen.
struct Frame {
  double x_min = 1e9, x_max = -1e9, y_min = 1e9, y_max = -1e9;
  void add(const TPoint2D& p) {
    x_min = std::min(x_min, p.x - kAround_m), x_max = std::max(x_max, p.x + kAround_m);
    y_min = std::min(y_min, p.y - kAround_m), y_max = std::max(y_max, p.y + kAround_m);
  }
};

Frame frameOf(const std::vector<SnapshotColumn>& columns) {
  Frame out;
  for (const auto& column : columns)
    for (const auto& s : column.snapshots) {
      out.add({s.robot.x, s.robot.y});
      out.add(s.goal);
      for (const auto& p : s.driven) out.add(p);
    }
  // and those who are near
  Frame all = out;
  for (const auto& column : columns)
    for (const auto& s : column.snapshots)
      for (const auto& o : s.others)
        if (o.position.x > out.x_min - 3 && o.position.x < out.x_max + 3 && o.position.y > out.y_min - 3 &&
            o.position.y < out.y_max + 3)
          all.add(o.position);
  return all;
}

/// The data blocks of one panel, their names ending in `n`, and the plot.
std::string panel(const std::string& title, const PlanSnapshot& s, const std::string& n) {
  const std::string nothing = "NaN NaN NaN NaN\n";
  std::string lines, best, people, arrows, driven;
  for (const auto& line : s.candidates) {
    std::string& to = line.chosen ? best : lines;
    for (const auto& p : line.points) to += row(p) + "\n";
    to += "\n";
  }
  for (const auto& o : s.others) {
    people += row(o.position) + " " + shortestNumber(o.radius_m) + "\n";
    if (o.velocity.norm() > 0.05) arrows += row(o.position) + " " + row(o.velocity) + "\n";
  }
  for (const auto& p : s.driven) driven += row(p) + "\n";
  const TPoint2D nose(std::cos(s.robot.phi) * s.radius_m, std::sin(s.robot.phi) * s.radius_m);
  const auto block = [&](const char* name, const std::string& text) {
    return std::string("$") + name + n + " << EOD\n" + text + nothing + "EOD\n";
  };
  return block("lines", lines) + block("best", best) + block("people", people) + block("arrows", arrows) +
         block("driven", driven) +
         block("robot", row({s.robot.x, s.robot.y}) + " " + shortestNumber(s.radius_m) + "\n") +
         block("nose", row({s.robot.x, s.robot.y}) + " " + row(nose) + "\n") + block("goal", row(s.goal) + "\n") +
         "set title " + gnuplotQuoted(title) + " noenhanced\nplot $walls u 1:2 w lines lw 2 lc rgb '#404040', $driven" +
         n + " u 1:2 w lines lw 2 dt 2 lc rgb '#888888', $lines" + n + " u 1:2 w lines lw 1.5 lc rgb '#2ca02c', $best" +
         n + " u 1:2 w lines lw 3.5 lc rgb '#d62728', $people" + n +
         " u 1:2:3 w circles lc rgb '#0072b2' fs solid 0.5, $arrows" + n +
         " u 1:2:3:4 w vectors head filled lw 1.5 lc rgb '#0072b2', $robot" + n +
         " u 1:2:3 w circles lc rgb '#d55e00' fs solid 0.6, $nose" + n +
         " u 1:2:3:4 w vectors nohead lw 2 lc rgb '#000000', $goal" + n +
         " u 1:2 w points pt 2 ps 1.5 lw 2 lc rgb '#d55e00'\n";
}

}  // namespace

void drawSnapshots(const std::vector<SnapshotColumn>& columns, std::span<const Segment> walls,
                   const std::string& png_file) {
  size_t rows = 1;
  for (const auto& column : columns) rows = std::max(rows, column.snapshots.size());
  const Frame view = frameOf(columns);
  const double shape = std::clamp((view.y_max - view.y_min) / std::max(view.x_max - view.x_min, 0.1), 0.2, 3.0);
  constexpr int kWide = 460, kFrame_px = 50;
  const auto wide = static_cast<size_t>(kWide), high = static_cast<size_t>(kFrame_px + shape * (kWide - kFrame_px));
  std::string script = "set terminal pngcairo noenhanced size " + std::to_string(wide * columns.size()) + "," +
                       std::to_string(high * rows) + " font 'sans,10'\nset encoding utf8\nset output " +
                       gnuplotQuoted(png_file) + "\n$walls << EOD\n";
  for (const auto& w : walls) script += row(w.a) + "\n" + row(w.b) + "\n\n";
  script += "NaN NaN\nEOD\nset multiplot layout " + std::to_string(rows) + "," + std::to_string(columns.size()) +
            "\nset size ratio -1\nunset key\nset tics nomirror out\nset border 3 lc rgb '#404040'\nset xrange [" +
            shortestNumber(view.x_min) + ":" + shortestNumber(view.x_max) + "]\nset yrange [" +
            shortestNumber(view.y_min) + ":" + shortestNumber(view.y_max) + "]\n";
  for (size_t k = 0; k < rows; ++k)
    for (const auto& column : columns) {
      if (k >= column.snapshots.size()) {
        script += "set multiplot next\n";
        continue;
      }
      const PlanSnapshot& s = column.snapshots[k];
      char time[32];
      std::snprintf(time, sizeof time, "%.1f s", s.time_s);
      script += panel(column.title + ", T" + std::to_string(k + 1) + " = " + time, s,
                      std::to_string(&column - columns.data()) + "_" + std::to_string(k));
    }
  runGnuplot(script + "unset multiplot\nunset output\n", png_file);
}

}  // namespace sidestep
