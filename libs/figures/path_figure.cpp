// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "figures/path_figure.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/errors.h"
#include "figures/gnuplot.h"
#include "maps/distance_field.h"

namespace sidestep {
namespace {

constexpr int kMostPixels = 1000;  // of the picture's map, a side
/// Colours of Okabe and Ito first, told apart with any colour vision.
constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00",
                                 "#56b4e9", "#000000", "#8c6d31", "#7f3c8d"};

struct Box {
  double x_min = 1e300, x_max = -1e300, y_min = 1e300, y_max = -1e300;

  void add(const mrpt::math::TPose2D& p) {
    x_min = std::min(x_min, p.x), x_max = std::max(x_max, p.x);
    y_min = std::min(y_min, p.y), y_max = std::max(y_max, p.y);
  }
};

std::string number(double value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

Box view(const PathFigure& figure) {
  Box box;
  box.add(figure.start);
  box.add(figure.goal);
  for (const auto& line : figure.lines)
    for (const auto& p : line.poses) box.add(p);
  const double margin = 1 + 0.1 * std::max(box.x_max - box.x_min, box.y_max - box.y_min);
  box.x_min -= margin, box.x_max += margin, box.y_min -= margin, box.y_max += margin;
  return box;
}

/// A file of grey bytes, one a pixel, that goes away with it.
class MapPixels {
 public:
  MapPixels(const PathFigure& figure, const Box& box)
      : file_((std::filesystem::temp_directory_path() / "sidestep-map-XXXXXX").string()) {
    const double side = std::max(box.x_max - box.x_min, box.y_max - box.y_min);
    pixel_m = std::max(figure.field->frame().resolution_m, side / kMostPixels);
    columns = static_cast<int>((box.x_max - box.x_min) / pixel_m) + 1;
    rows = static_cast<int>((box.y_max - box.y_min) / pixel_m) + 1;
    std::string bytes;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double d = figure.field->clearance(box.x_min + column * pixel_m, box.y_min + row * pixel_m);
        bytes += static_cast<char>(d < 0.5 * pixel_m ? 90 : (d < figure.clearance_m ? 215 : 255));
      }
    const int fd = mkstemp(file_.data());
    const bool written = fd >= 0 && write(fd, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
    if (fd >= 0) close(fd);
    if (!written) throw Error(ExitCode::kInternalError, file_ + ": no temporary file for the picture");
  }
  ~MapPixels() { unlink(file_.c_str()); }
  MapPixels(const MapPixels&) = delete;
  MapPixels& operator=(const MapPixels&) = delete;

  std::string plot(const Box& box) const {
    return gnuplotQuoted(file_) + " binary array=(" + std::to_string(columns) + "," + std::to_string(rows) +
           ") format='%uchar' origin=(" + number(box.x_min) + "," + number(box.y_min) + ") dx=" + number(pixel_m) +
           " dy=" + number(pixel_m) + " using 1:1:1 with rgbimage notitle";
  }

 private:
  std::string file_;
  double pixel_m = 0;
  int columns = 0, rows = 0;
};

std::string block(const std::string& name, const std::vector<mrpt::math::TPose2D>& poses) {
  std::string out = name + " << EOD\n";
  for (const auto& p : poses) out += number(p.x) + " " + number(p.y) + "\n";
  return out + "EOD\n";
}

std::string settings(const PathFigure& figure, const Box& box, const std::string& png_file) {
  return "set terminal pngcairo noenhanced size 1100,900 font 'sans,12'\nset encoding utf8\nset output " +
         gnuplotQuoted(png_file) + "\nset title " + gnuplotQuoted(figure.title) + " noenhanced font ',14'\n" +
         "set size ratio -1\nset border 3 lc rgb '#404040'\nset tics nomirror out\nset xlabel 'x [m]'\n"
         "set ylabel 'y [m]'\nset key outside below center horizontal Left reverse noenhanced samplen 3\n"
         "set xrange [" +
         number(box.x_min) + ":" + number(box.x_max) + "]\nset yrange [" + number(box.y_min) + ":" + number(box.y_max) +
         "]\n";
}

}  // namespace

void drawPaths(const PathFigure& figure, const std::string& png_file) {
  const Box box = view(figure);
  const MapPixels pixels(figure, box);
  std::string data = block("$start", {figure.start}) + block("$goal", {figure.goal}), plots = pixels.plot(box);
  for (size_t i = 0; i < figure.lines.size(); ++i) {
    const std::string name = "$line" + std::to_string(i);
    data += block(name, figure.lines[i].poses);
    plots += ", " + name + " using 1:2 with lines lw 2 lc rgb '" + kColours[i % kColours.size()] + "' title " +
             gnuplotQuoted(figure.lines[i].name);
  }
  plots += ", $start using 1:2 with points pt 7 ps 1.6 lc rgb '#009e73' title 'start'";
  plots += ", $goal using 1:2 with points pt 5 ps 1.2 lc rgb '#d55e00' title 'goal'";
  runGnuplot(data + settings(figure, box, png_file) + "plot " + plots + "\nunset output\n", png_file);
}

}  // namespace sidestep
