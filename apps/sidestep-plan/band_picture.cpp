// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "sidestep-plan/band_picture.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "figures/gnuplot.h"

namespace sidestep {
namespace {

std::string row(double x, double y) {
  char text[64];
  std::snprintf(text, sizeof text, "%.4f %.4f\n", x, y);
  return text;
}

std::string points(const Band& band) {
  std::string out;
  for (const auto& p : band) out += row(p.x, p.y);
  return out + "\n";
}

}  // namespace

void BandPicture::add(const BandProblemCase& problem, const BandPlanner& planner, double radius_m) {
  const std::string n = std::to_string(panels_++);
  std::string obstacles, others, best;
  for (const auto& o : problem.obstacles) obstacles += row(o.position.x, o.position.y);
  for (const auto& c : planner.candidates())
    if (c.alive) (c.chosen ? best : others) += points(c.band);
  if (others.empty()) others = row(0, 0);
  if (best.empty()) best = row(0, 0);
  data_ += "$o" + n + " << EOD\n" + obstacles + "EOD\n$a" + n + " << EOD\n" + others + "EOD\n$b" + n + " << EOD\n" +
           best + "EOD\n";
  plots_ += "set title '" + std::to_string(problem.n_obs) + " obstacles, seed " + std::to_string(problem.seed) +
            "'\nplot $o" + n + " u 1:2:(" + shortestNumber(radius_m) + ") w circles lc rgb '#bbbbbb', $a" + n +
            " w lines lc rgb '#777777', $b" + n + " w linespoints pt 7 ps 0.4 lc rgb '#cc0000'\n";
}

void BandPicture::write(const std::string& file) const {
  const int columns = panels_ <= 4 ? std::max(1, std::min(panels_, 2)) : 3, rows = (panels_ + columns - 1) / columns;
  runGnuplot("set terminal pngcairo size " + std::to_string(500 * columns) + "," +
                 std::to_string(400 * std::max(1, rows)) + "\nset output " + gnuplotQuoted(file) + "\n" + data_ +
                 "set multiplot layout " + std::to_string(std::max(1, rows)) + "," + std::to_string(columns) +
                 "\nset size ratio -1\nunset key\nset xrange [-0.8:8.8]\nset yrange [-4.8:4.8]\n" + plots_ +
                 "unset multiplot\n",
             "the picture of the bands");
}

}  // namespace sidestep
