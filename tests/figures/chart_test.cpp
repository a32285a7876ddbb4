// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Charts show whatever the numbers are.
#include "figures/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "core/errors.h"
#include "support/temporary_folder.h"

namespace sidestep {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();

BarChart barsOf(const std::vector<double>& values) {
  BarChart chart;
  chart.title = "it's a_{title}";
  chart.value_label = "value";
  chart.series.push_back({"it's one", {}});
  for (size_t i = 0; i < values.size(); ++i) {
    chart.clusters.push_back("scenario " + std::to_string(i));
    const double v = values[i];
    chart.series[0].bars.push_back({i, {v, v - 0.1 * std::abs(v), v + 0.1 * std::abs(v)}, std::nullopt});
  }
  return chart;
}

CurveChart curvesOf(const std::vector<double>& xs, const std::vector<double>& values) {
  CurveChart chart;
  chart.panels.push_back({"panel", {{"one", 0, {}}}});
  for (size_t i = 0; i < xs.size(); ++i)
    chart.panels[0].curves[0].points.push_back({xs[i], {values[i], values[i], values[i]}});
  return chart;
}

/// Pixels of the first series' colour, #0072b2.
int bluePixels(const std::string& png) {
  const cv::Mat picture = cv::imread(png);
  int count = 0;
  for (const auto& p : cv::Mat_<cv::Vec3b>(picture))
    count += std::abs(p[0] - 0xb2) < 50 && std::abs(p[1] - 0x72) < 50 && p[2] < 60;
  return count;
}

TEST(Chart, NegativeBarsAreAsLargeAsPositiveOnes) {
  const support::TemporaryFolder folder;
  ASSERT_TRUE(drawBars(barsOf({0.5, 0.2}), folder / "up.png"));
  ASSERT_TRUE(drawBars(barsOf({-0.5, -0.2}), folder / "down.png"));
  const int up = bluePixels(folder / "up.png"), down = bluePixels(folder / "down.png");
  EXPECT_GT(up, 10000);
  EXPECT_NEAR(down, up, 0.15 * up);
}

TEST(Chart, BarsOfAnyNumbersAreDrawn) {
  const support::TemporaryFolder folder;
  for (const auto& values : std::vector<std::vector<double>>{{0, 0},
                                                             {-1, 2},
                                                             {-1e-300, -2e-300},
                                                             {-1e-9, 1e9},
                                                             {1e-12, 1e12},
                                                             {5, kNaN},
                                                             {kInf, 5},
                                                             {1e300, -3},
                                                             {-1e80, 1e90}})
    EXPECT_TRUE(drawBars(barsOf(values), folder / "bars.png")) << values[0] << " " << values[1];
}

TEST(Chart, CurvesOfAnyNumbersAreDrawn) {
  const support::TemporaryFolder folder;
  EXPECT_TRUE(drawCurves(curvesOf({1, 2, 3}, {-1, -2, -3}), folder / "c.png"));
  EXPECT_GT(bluePixels(folder / "c.png"), 100);
  EXPECT_TRUE(drawCurves(curvesOf({0}, {0}), folder / "c.png"));
  EXPECT_TRUE(drawCurves(curvesOf({-2, 0, 2}, {1e-9, -5, kNaN}), folder / "c.png"));
  EXPECT_TRUE(drawCurves(curvesOf({1, 10}, {1e-300, 1e90}), folder / "c.png"));
  EXPECT_TRUE(drawCurves(curvesOf({1, 10}, {kInf, 3}), folder / "c.png"));
}

TEST(Chart, WithoutAnyNumberThereIsNoFile) {
  const support::TemporaryFolder folder;
  EXPECT_FALSE(drawBars(barsOf({kNaN, kInf}), folder / "none.png"));
  EXPECT_FALSE(drawBars(barsOf({}), folder / "none.png"));
  EXPECT_FALSE(drawCurves(curvesOf({1, 2}, {kNaN, kNaN}), folder / "none.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "none.png"));
}

TEST(Chart, APublishedNumberBelowZeroIsInThePicture) {
  const support::TemporaryFolder folder;
  BarChart chart = barsOf({0.5});
  ASSERT_TRUE(drawBars(chart, folder / "without.png"));
  chart.series[0].bars[0].published = -0.5;
  ASSERT_TRUE(drawBars(chart, folder / "with.png"));
  // the axis goes down as far as up, so the bar has about half of its height
  EXPECT_LT(bluePixels(folder / "with.png"), 0.7 * bluePixels(folder / "without.png"));
}

TEST(Chart, AFolderThatIsNotThereIsAnError) { EXPECT_THROW(drawBars(barsOf({1}), "/nowhere/at/all/bars.png"), Error); }

}  // namespace
}  // namespace sidestep
