// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace sidestep {

/// A number with its 95 % interval; not finite: there is none.
struct ChartValue {
  double value = 0, low = 0, high = 0;
};

/// Bars: a cluster a scenario, in it a bar a series.
struct BarChart {
  struct Bar {
    size_t cluster = 0;
    ChartValue value;
    std::optional<double> published;  ///< drawn as a red line
  };
  struct Series {
    std::string name;
    std::vector<Bar> bars;
  };
  std::string title, value_label;
  std::vector<std::string> clusters;
  std::vector<Series> series;
};

/// Curves over an axis with their bands: a panel a scenario, side by side, with the same scales.
struct CurveChart {
  struct Point {
    double x = 0;
    ChartValue value;
  };
  struct Curve {
    std::string name;
    size_t colour = 0;  ///< of figureColour
    std::vector<Point> points;
  };
  struct Panel {
    std::string title;
    std::vector<Curve> curves;
  };
  std::string title, x_label, value_label;
  std::vector<Panel> panels;
};

/// The axis begins at 0, or below where there are values below; it is logarithmic where all are above 0 and differ by
/// more than 30 times. Same chart, same bytes.
/// @return false, and no file, if there is nothing to draw
/// @throws Error (internal) with gnuplot's message if it cannot be run.
bool drawBars(const BarChart& chart, const std::string& png_file);
bool drawCurves(const CurveChart& chart, const std::string& png_file);

}  // namespace sidestep
