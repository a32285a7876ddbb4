// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/study/study_figures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>

#include "figures/chart.h"

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

ChartValue valueOf(const SummaryLine& line) { return {line.summary.mean, line.summary.ci_low, line.summary.ci_high}; }

/// Rows of the table without an axis: a cluster a scenario, a bar an algorithm.
BarChart barsOf(const Study& study, const std::string& metric, const std::string& what, const Lines& lines) {
  BarChart chart;
  chart.title = axisTitle(metric) + ", " + what + " and 95 % interval";
  chart.value_label = axisTitle(metric);
  for (const auto& name : study.algorithms()) chart.series.push_back({name, {}});
  for (const auto* l : lines) {
    if (chart.clusters.empty() || chart.clusters.back() != l->scenario) chart.clusters.push_back(l->scenario);
    chart.series[l->algorithm].bars.push_back({chart.clusters.size() - 1, valueOf(*l), l->reference});
  }
  return chart;
}

/// A curve without points for each algorithm.
CurveChart::Panel emptyPanel(const Study& study, const std::string& title) {
  CurveChart::Panel panel;
  panel.title = title;
  for (size_t a = 0; a < study.algorithms().size(); ++a) panel.curves.push_back({study.algorithms()[a], a, {}});
  return panel;
}

/// Rows on an axis: a panel a scenario of the group.
CurveChart curvesOf(const Study& study, const std::string& metric, const std::string& what, const std::string& group,
                    const Lines& lines) {
  CurveChart chart;
  chart.title = group + ": " + axisTitle(metric) + ", " + what + " and 95 % band";
  chart.x_label = axisTitle(study.rows()[lines.front()->row].axis);
  chart.value_label = axisTitle(metric);
  size_t scenario = 0;  // of the last panel
  for (const auto* l : lines) {
    const auto& row = study.rows()[l->row];
    if (chart.panels.empty() || scenario != row.scenario) {
      scenario = row.scenario;
      chart.panels.push_back(emptyPanel(study, row.name.substr(0, row.name.rfind('@'))));
    }
    chart.panels.back().curves[l->algorithm].points.push_back({*row.x, valueOf(*l)});
  }
  return chart;
}

/// Draws figures one after the other; one that fails is told of, and the next one is drawn.
class Drawing {
 public:
  explicit Drawing(const std::string& folder) : folder_(folder) {}
  /// @param draw  of a file's path; false if there was nothing to draw
  void add(const std::string& name, const std::string& title, const std::function<bool(const std::string&)>& draw) {
    StudyFigure figure{fileName(name), title, ""};
    try {
      if (!draw((std::filesystem::path(folder_) / figure.file).string())) return;
    } catch (const std::exception& e) {
      figure.failure = e.what();
    }
    figures.push_back(figure);
  }
  std::vector<StudyFigure> figures;

 private:
  std::string folder_;
};

/// @param what  "mean" or "median"
void drawMetric(const Study& study, const std::string& metric, const std::string& what,
                const std::vector<SummaryLine>& lines, Drawing& out) {
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
  const std::string name = what == "mean" ? metric : metric + "-" + what;
  const std::string title = axisTitle(metric) + (what == "mean" ? "" : ", " + what);
  if (!plain.empty())
    out.add(name, title, [&](const auto& png) { return drawBars(barsOf(study, metric, what, plain), png); });
  for (const auto& [group, members] : groups)
    out.add(name + "-" + group, group + ": " + title, [&, &g = group, &m = members](const auto& png) {
      return drawCurves(curvesOf(study, metric, what, g, m), png);
    });
}

/// The first run of each row with each algorithm of `pictures`, and all of them over time.
void drawRuns(const Study& study, Drawing& out) {
  const auto& all = study.algorithms();
  const auto placeOf = [&](size_t row, const std::string& name) {
    return study.place(row, static_cast<size_t>(std::find(all.begin(), all.end(), name) - all.begin()), 0);
  };
  for (const auto& name : study.pictures)
    for (size_t row = 0; row < study.rows().size(); ++row) {
      const std::string title = study.rows()[row].name + ", " + name + ", run 0";
      out.add("run-" + study.rows()[row].name + "-" + name, title,
              [&](const auto& png) { return study.runner().draw(placeOf(row, name), title, png); });
    }
  for (size_t row = 0; row < study.rows().size(); ++row) {
    std::vector<StudyPlace> places;
    for (const auto& name : study.pictures) places.push_back(placeOf(row, name));
    if (places.empty()) continue;
    const std::string title = study.rows()[row].name + ", run 0";
    out.add("time-" + study.rows()[row].name, title + ", over time",
            [&](const auto& png) { return study.runner().drawTogether(places, study.pictures, title, png); });
  }
}

}  // namespace

std::vector<StudyFigure> drawStudy(const Study& study, const std::vector<SummaryLine>& lines,
                                   const std::vector<SummaryLine>& medians, const std::string& folder) {
  Drawing out(folder);
  for (const auto& metric : study.figures) drawMetric(study, metric, "mean", lines, out);
  for (const auto& metric : study.medians) drawMetric(study, metric, "median", medians, out);
  drawRuns(study, out);
  return std::move(out.figures);
}

}  // namespace sidestep
