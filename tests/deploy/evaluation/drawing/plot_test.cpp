// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/drawing/plot.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "deploy/evaluation/drawing/svg.hpp"
#include "tests/deploy/evaluation/drawing/svg_elements.hpp"

namespace quoin::deploy {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void expect_well_formed(const std::string& svg) {
  EXPECT_NO_THROW((void)svg_elements(svg));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

LineChart times() {
  LineChart chart;
  chart.title = "time <of> two";
  chart.x = {"measurements", false};
  chart.y = {"time [us]", true};
  chart.series = {{"cwlf", {10.0, 50.0, 100.0}, {1.0, 10.0, 100.0}},
                  {"arras_siegwart", {10.0, 50.0, 100.0}, {10.0, 100.0, 1000.0}}};
  return chart;
}

IntervalChart coverage() {
  IntervalChart chart;
  chart.title = "coverage";
  chart.x = {"coverage [%]", false, 40.0, 100.0};
  chart.categories = {"utls", "a_fitter_with_a_long_name"};
  chart.series = {{"propagated", {PlottedInterval{95.0, 94.0, 96.0}, PlottedInterval{70, 68, 72}}},
                  {"as_published", {std::nullopt, PlottedInterval{10.0, 8.0, 12.0}}}};
  chart.reference = 95.0;
  chart.reference_name = "95 %";
  return chart;
}

BoxPlot areas() {
  BoxPlot plot;
  plot.title = "areas";
  plot.y = {"area [mm^2]", true};
  plot.categories = {"utls", "wctls"};
  plot.series = {{"propagated",
                  {PlottedBox{100.0, 200.0, 300.0, 400.0, 800.0, {2000.0}},
                   PlottedBox{10.0, 20.0, 30.0, 40.0, 80.0, {}}}}};
  plot.points = {{"paper", {PlottedInterval{4498.5, 4168.2, 4828.8}, std::nullopt}}};
  return plot;
}

TEST(Scale, RunsLinearlyOrByDecades) {
  const Scale linear({"", false, 0.0, 10.0}, {}, 100.0, 200.0);
  EXPECT_DOUBLE_EQ(linear.pixel(2.5), 125.0);
  EXPECT_DOUBLE_EQ(linear.pixel(-3.0), 100.0);
  EXPECT_FALSE(linear.shows(-3.0));
  EXPECT_FALSE(linear.shows(nan));
  const Scale logarithmic({"", true, 1.0, 100.0}, {}, 300.0, 100.0);  // pixels run down
  EXPECT_DOUBLE_EQ(logarithmic.pixel(10.0), 200.0);
  EXPECT_DOUBLE_EQ(logarithmic.pixel(100.0), 100.0);
  EXPECT_DOUBLE_EQ(logarithmic.pixel(-1.0), 300.0);
}

TEST(Scale, CoversTheDataAndHasReadableTicks) {
  for (const double size : {1e-7, 1e-3, 0.4, 1.0, 17.0, 900.0, 3e6}) {
    for (const bool logarithmic : {false, true}) {
      const Scale scale({"", logarithmic}, {0.013 * size, 0.5 * size, size, nan}, 0.0, 600.0);
      EXPECT_TRUE(scale.shows(size));
      EXPECT_TRUE(scale.shows(0.013 * size));
      std::size_t labels = 0;
      double last = -1e9;
      for (const Tick& tick : scale.ticks()) {
        EXPECT_TRUE(scale.shows(tick.value) || tick.value == 0.0) << tick.value;
        if (tick.label.empty()) continue;
        ++labels;
        EXPECT_GT(scale.pixel(tick.value) - last, 40.0) << tick.label;
        EXPECT_NEAR(std::stod(tick.label), tick.value, 1e-3 * std::abs(tick.value));
        last = scale.pixel(tick.value);
      }
      EXPECT_GE(labels, logarithmic ? 1U : 4U) << size;
      EXPECT_LE(labels, 14U) << size;
    }
  }
}

TEST(Scale, OfOneValueOrNoneIsAScaleToo) {
  for (const bool logarithmic : {false, true}) {
    const Scale one({"", logarithmic}, {3.0}, 0.0, 600.0);
    EXPECT_TRUE(one.shows(3.0));
    EXPECT_FALSE(one.ticks().empty());
    const Scale none({"", logarithmic}, {}, 0.0, 600.0);
    EXPECT_FALSE(none.ticks().empty());
  }
}

TEST(LineChart, HasACurveAndMarkersForEachSeries) {
  const std::string svg = plot_svg(times());
  expect_well_formed(svg);
  EXPECT_THAT(svg, HasSubstr("time &lt;of&gt; two"));
  EXPECT_THAT(svg, HasSubstr("time [us]"));
  EXPECT_THAT(svg, HasSubstr("arras_siegwart"));
  EXPECT_EQ(svg_elements(svg, "curve s0 d0").size(), 2U);  // one in the legend
  EXPECT_EQ(svg_elements(svg, "curve s1 d1").size(), 2U);
  const auto markers = svg_elements(svg, "marker s0");
  ASSERT_EQ(markers.size(), 4U);
  // Equal factors are equal distances on a logarithmic axis.
  EXPECT_NEAR(markers[1].number("cy") - markers[2].number("cy"),
              markers[2].number("cy") - markers[3].number("cy"), 0.03);
  EXPECT_NEAR((markers[2].number("cx") - markers[1].number("cx")) * 50.0,
              (markers[3].number("cx") - markers[2].number("cx")) * 40.0, 2.0);
}

TEST(LineChart, LeavesOutWhatCannotBeShown) {
  LineChart chart = times();
  chart.series[0].y = {nan, 0.0, -1.0};
  const std::string svg = plot_svg(chart);
  expect_well_formed(svg);
  EXPECT_EQ(svg_elements(svg, "marker s0").size(), 1U);
  expect_well_formed(plot_svg(LineChart{}));
}

TEST(IntervalChart, HasPointsWhiskersAndTheReference) {
  const std::string svg = plot_svg(coverage());
  expect_well_formed(svg);
  const auto markers = svg_elements(svg, "marker s0");
  ASSERT_EQ(markers.size(), 3U);
  const auto reference = svg_elements(svg, "reference");
  ASSERT_EQ(reference.size(), 2U);
  EXPECT_NEAR(markers[1].number("cx"), reference[1].number("x1"), 0.02);
  EXPECT_LT(markers[2].number("cx"), markers[1].number("cx"));
  // Below the axis: not shown rather than put at its end.
  EXPECT_EQ(svg_elements(svg, "marker s1").size(), 1U);
  const auto whiskers = svg_elements(svg, "whisker s0");
  ASSERT_EQ(whiskers.size(), 7U);
  EXPECT_NEAR(0.5 * (whiskers[1].number("x1") + whiskers[1].number("x2")), markers[1].number("cx"),
              0.02);
  expect_well_formed(plot_svg(IntervalChart{}));
}

TEST(BoxPlot, HasBoxesWhereTheQuartilesAre) {
  const std::string svg = plot_svg(areas());
  expect_well_formed(svg);
  const auto boxes = svg_elements(svg, "box s0");
  ASSERT_EQ(boxes.size(), 3U);
  // Both boxes span a factor of 2 and are a factor of 10 apart.
  EXPECT_NEAR(boxes[1].number("height"), boxes[2].number("height"), 0.03);
  EXPECT_NEAR((boxes[2].number("y") - boxes[1].number("y")) / boxes[1].number("height"),
              std::log(10.0) / std::log(2.0), 0.01);
  EXPECT_EQ(svg_elements(svg, "outlier s0").size(), 1U);
  EXPECT_EQ(svg_elements(svg, "marker s1").size(), 2U);  // one in the legend
  expect_well_formed(plot_svg(BoxPlot{}));
}

TEST(Plots, KeepTheirStylesToThemselves) {
  EXPECT_EQ(scoped(".plot", "text,.a{fill:red}.b{fill:blue}"),
            ".plot text,.plot .a{fill:red}.plot .b{fill:blue}");
  EXPECT_THAT(plot_svg(times()), HasSubstr("prefers-color-scheme:dark"));
}

}  // namespace
}  // namespace quoin::deploy
