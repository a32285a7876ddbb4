// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/world_figure.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "core/errors.h"
#include "core/params.h"
#include "figures/gnuplot.h"

namespace sidestep {
namespace {

using mrpt::math::TPoint2D;

bool isThere(const TPoint2D& p) { return std::isfinite(p.x) && std::isfinite(p.y); }

struct View {
  double x_min = std::numeric_limits<double>::infinity(), x_max = -x_min, y_min = x_min, y_max = -x_min;
  void add(const TPoint2D& p, double margin) {
    if (!isThere(p)) return;
    x_min = std::min(x_min, p.x - margin), x_max = std::max(x_max, p.x + margin);
    y_min = std::min(y_min, p.y - margin), y_max = std::max(y_max, p.y + margin);
  }
};

/// All that moved, and the walls near it.
View viewOf(const WorldFigure& figure) {
  View view;
  for (const auto& path : figure.paths)
    for (const auto& p : path.places) view.add(p, path.radius_m + 0.5);
  view.add(figure.goal, 1);
  View all = view;
  for (const auto& wall : figure.walls) all.add(wall.a, 0.3), all.add(wall.b, 0.3);
  const double most = 0.5 * std::max(view.x_max - view.x_min, view.y_max - view.y_min) + 2;
  return {std::max(all.x_min, view.x_min - most), std::min(all.x_max, view.x_max + most),
          std::max(all.y_min, view.y_min - most), std::min(all.y_max, view.y_max + most)};
}

std::string number(double value) { return shortestNumber(value); }

std::string wallsBlock(const WorldFigure& figure) {
  std::string out = "$walls << EOD\n";
  for (const auto& w : figure.walls)
    out += number(w.a.x) + " " + number(w.a.y) + "\n" + number(w.b.x) + " " + number(w.b.y) + "\n\n";
  return out + (figure.walls.empty() ? "NaN NaN\n" : "") + "EOD\n";
}

std::string head(const WorldFigure& figure, double duration_s) {
  const View v = viewOf(figure);
  const double width = v.x_max - v.x_min, height = v.y_max - v.y_min;
  const int high = std::clamp(static_cast<int>(900 * height / std::max(width, 0.1)), 420, 1400) / 2 * 2;
  return "set terminal pngcairo noenhanced size 1000," + std::to_string(high) + " font 'sans,12'\nset encoding utf8\n" +
         "set title " + gnuplotQuoted(figure.title) +
         " noenhanced\nset size ratio -1\nset border 3 lc rgb '#404040'\n" +
         "set tics nomirror out\nset grid back lt 1 lc rgb '#e8e8e8'\nset xlabel 'x [m]'\nset ylabel 'y [m]'\n" +
         "set xrange [" + number(v.x_min) + ":" + number(v.x_max) + "]\nset yrange [" + number(v.y_min) + ":" +
         number(v.y_max) +
         "]\nset palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n" +
         "set cbrange [0:" + number(std::max(duration_s, 0.1)) + "]\nset cblabel 'time [s]'\nunset key\n" +
         wallsBlock(figure);
}

double durationOf(const WorldFigure& figure) {
  size_t most = 1;
  for (const auto& path : figure.paths) most = std::max(most, path.places.size());
  return figure.period_s * static_cast<double>(most - 1);
}

std::string goalPart(const WorldFigure& figure) {
  return ", '-' using 1:2 with points pt 2 ps 2 lw 3 lc rgb '#d55e00'\n" + number(figure.goal.x) + " " +
         number(figure.goal.y) + "\ne\n";
}

int runProgramAndWait(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (auto& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0) return -1;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

}  // namespace

void drawWorld(const WorldFigure& figure, const std::string& png_file) {
  const double duration = durationOf(figure), disc_period = std::max(1.0, std::round(duration / 10));
  std::string lines = "$lines << EOD\n", discs = "$discs << EOD\n", thick = "$thick << EOD\n";
  for (const auto& path : figure.paths) {
    std::string& to = path.is_robot ? thick : lines;
    double next_disc = 0;
    for (size_t k = 0; k < path.places.size(); ++k) {
      const TPoint2D& p = path.places[k];
      const double t = figure.period_s * static_cast<double>(k);
      const std::string at = number(p.x) + " " + number(p.y) + " ";
      if (isThere(p)) to += at + number(t);
      to += "\n";
      if (t + 1e-9 < next_disc) continue;
      next_disc += disc_period;
      if (isThere(p)) discs += at + number(path.radius_m) + " " + number(t) + "\n";
    }
    to += "\n";
  }
  const std::string empty = "NaN NaN 0 0\n";
  runGnuplot(head(figure, duration) + lines + empty + "EOD\n" + thick + empty + "EOD\n" + discs + empty + "EOD\n" +
                 "set output " + gnuplotQuoted(png_file) + "\nplot $walls using 1:2 with lines lw 2 lc rgb '#404040'" +
                 ", $lines using 1:2:3 with lines lw 1.5 lc palette, $thick using 1:2:3 with lines lw 5 lc palette" +
                 ", $discs using 1:2:3:4 with circles lw 1.2 lc palette fs empty" + goalPart(figure) + "unset output\n",
             png_file);
}

void requireFfmpeg() {
  const char* path = std::getenv("PATH");
  std::string rest = path != nullptr ? path : "";
  while (!rest.empty()) {
    const std::string folder = rest.substr(0, rest.find(':'));
    if (!folder.empty() && access((folder + "/ffmpeg").c_str(), X_OK) == 0) return;
    rest = rest.size() > folder.size() ? rest.substr(folder.size() + 1) : "";
  }
  throw ConfigError("--video: ffmpeg is not installed; install it (apt-get install ffmpeg), or leave --video out");
}

void filmWorld(const WorldFigure& figure, const std::string& frames_folder, const std::string& mp4_file) {
  const double duration = durationOf(figure);
  const auto frames = static_cast<size_t>(std::llround(duration / figure.period_s)) + 1;
  std::string script = head(figure, duration);
  for (size_t k = 0; k < frames; ++k) {
    std::string discs;
    for (const auto& path : figure.paths)
      if (k < path.places.size() && isThere(path.places[k]))
        discs += number(path.places[k].x) + " " + number(path.places[k].y) + " " + number(path.radius_m) +
                 (path.is_robot ? " 0xd55e00\n" : " 0x0072b2\n");
    char name[32];
    std::snprintf(name, sizeof name, "/%06zu.png", k);
    script += "set output " + gnuplotQuoted(frames_folder + name) + "\n$d << EOD\n" + discs + "NaN NaN 0 0\nEOD\n" +
              "plot $walls using 1:2 with lines lw 2 lc rgb '#404040', $d using 1:2:3:4 with circles lc rgb variable " +
              "fs solid 0.6" + goalPart(figure);
  }
  runGnuplot(script + "unset output\n", mp4_file);
  const int status = runProgramAndWait({"ffmpeg", "-y", "-loglevel", "error", "-framerate", number(1 / figure.period_s),
                                        "-i", frames_folder + "/%06d.png", "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                        "-pix_fmt", "yuv420p", mp4_file});
  if (status != 0) throw Error(ExitCode::kInternalError, mp4_file + ": ffmpeg failed");
}

}  // namespace sidestep
