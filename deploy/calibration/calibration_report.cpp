// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/calibration/calibration_report.hpp"

#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/geometry/angle.hpp"
#include "deploy/evaluation/drawing/plot.hpp"
#include "deploy/evaluation/drawing/svg.hpp"
#include "deploy/evaluation/html.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t table_width = 120;
constexpr int digits_of_millimetres = 2;

struct Row {
  const char* name;
  const char* unit;
  Interval interval;
  double scale;
  int digits;
  const char* meaning;
};

std::vector<Row> rows_of(const Calibration& calibration) {
  const NoiseEstimate& noise = calibration.noise;
  const double degree = 180.0 / pi;
  std::vector<Row> rows{
      {"range_stddev", "mm", noise.range_stddev, 1e3, digits_of_millimetres, "of each range"},
      {"range_stddev_per_metre", "mm/m", noise.range_stddev_per_metre, 1e3, digits_of_millimetres,
       "what grows with the range"},
      {"bearing_stddev", "deg", noise.bearing_stddev, degree, 3,
       "what grows with range and incidence"},
      {"flatness_stddev", "mm", noise.flatness_stddev, 1e3, digits_of_millimetres,
       "shared by neighbouring rays: walls, slow errors"},
      {"range noise at middle range", "mm", noise.middle_range_stddev, 1e3, digits_of_millimetres,
       "of the points on walls"},
      {"odd against even rays", "mm", noise.interlace_stddev, 1e3, digits_of_millimetres,
       "motion between two sweeps of one scan"},
      {"correlation of neighbours", "", noise.neighbour_correlation, 1.0, 2, "0 for white noise"}};
  if (calibration.bias) {
    rows.push_back({"range_bias", "mm", calibration.bias->bias, 1e3, digits_of_millimetres,
                    "measured less given distance"});
  }
  return rows;
}

std::string bound(double value, const Row& row) {
  return std::isfinite(value) ? fixed(row.scale * value, row.digits) : "?";
}

std::string range_text(const Row& row) {
  return bound(row.interval.low, row) + " .. " + bound(row.interval.high, row);
}

std::string what_it_rests_on(const NoiseEstimate& noise) {
  std::string text = std::to_string(noise.scans) + " scans, " + std::to_string(noise.walls) +
                     " walls, " + std::to_string(noise.points) + " points; ranges " +
                     fixed(noise.nearest, 1) + " to " + fixed(noise.farthest, 1) +
                     " m, incidence up to " + fixed(noise.steepest * 180.0 / pi, 0) + " deg";
  text += noise.quantization > 0.0
              ? "; ranges come in steps of " + fixed(1e3 * noise.quantization, 2) + " mm"
              : "";
  return text;
}

std::string text_of(NoiseGap gap, const NoiseEstimate& noise) {
  switch (gap) {
    case NoiseGap::few_walls:
      return "only " + std::to_string(noise.walls) + " walls: take more scans (--duration)";
    case NoiseGap::few_long_walls:
      return "only " + std::to_string(noise.long_walls) +
             " walls of 20 points and more: take more scans, or nearer to walls";
    case NoiseGap::wide_interval:
      return "the range noise is uncertain by more than a quarter (" +
             fixed(1e3 * noise.middle_range_stddev.low, 1) + " to " +
             fixed(1e3 * noise.middle_range_stddev.high, 1) + " mm): take more scans";
    case NoiseGap::uniform_range:
      return "all walls are about " + fixed(noise.middle_range, 1) +
             " m away: take scans with near and far walls";
    case NoiseGap::uniform_incidence:
      return "all walls are met head on, below " + fixed(noise.steepest * 180.0 / pi, 0) +
             " deg: take scans along walls as well";
    case NoiseGap::no_walls:
      return fixed(100.0 * noise.refuted, 0) +
             " % of the walls are none: clutter, round surfaces or a moving scene; take scans of "
             "a room at rest";
  }
  return {};
}

nlohmann::ordered_json json_of(const Interval& interval) {
  nlohmann::ordered_json object{{"value", interval.value}, {"low", nullptr}, {"high", nullptr}};
  if (std::isfinite(interval.low)) object["low"] = interval.low;
  if (std::isfinite(interval.high)) object["high"] = interval.high;
  return object;
}

nlohmann::ordered_json json_of(const std::vector<NoiseBand>& bands) {
  auto array = nlohmann::ordered_json::array();
  for (const NoiseBand& band : bands) {
    array.push_back({{"low", band.low},
                     {"high", band.high},
                     {"points", band.points},
                     {"measured", band.measured},
                     {"modelled", band.modelled}});
  }
  return array;
}

std::string plot(const char* title, const char* axis, const std::vector<NoiseBand>& bands,
                 double scale) {
  LineChart chart{title,
                  {axis},
                  {.title = "standard deviation of ranges [mm]", .low = 0.0},
                  {{"measured", {}, {}}, {"by the components", {}, {}}}};
  for (const NoiseBand& band : bands) {
    for (LineSeries& series : chart.series)
      series.x.push_back(scale * 0.5 * (band.low + band.high));
    chart.series[0].y.push_back(1e3 * band.measured);
    chart.series[1].y.push_back(1e3 * band.modelled);
  }
  return plot_svg(chart);
}

}  // namespace

std::vector<std::string> shortcomings(const Calibration& calibration) {
  std::vector<std::string> texts;
  for (const NoiseGap gap : gaps_of(calibration.noise)) {
    texts.push_back(text_of(gap, calibration.noise));
  }
  if (calibration.distance && !calibration.bias) {
    texts.push_back(
        "no wall is seen head on within 0.3 m of " + number(*calibration.distance, 3) +
        " m: measure the distance from the sensor's axis square to a wall (--distance)");
  }
  return texts;
}

std::vector<std::string> calibration_lines(const Calibration& calibration) {
  std::vector<std::vector<std::string>> rows{{"component", "meaning", "unit", "value", "95 %"}};
  for (const Row& row : rows_of(calibration)) {
    rows.push_back({row.name, row.meaning, row.unit,
                    fixed(row.scale * row.interval.value, row.digits), range_text(row)});
  }
  std::vector<std::string> lines;
  append_table(rows, 3, table_width, lines);
  lines.push_back(what_it_rests_on(calibration.noise));
  return lines;
}

std::string sensor_block(const Calibration& calibration, const std::string& origin) {
  const NoiseComponents& found = calibration.noise.components;
  const auto line = [](const char* key, double value, int digits, const char* unit) {
    return "  " + std::string(key) + ": " + number(value, digits) + "  # " + unit + '\n';
  };
  std::string comment;
  for (const char character : origin)
    comment += character < ' ' && character >= 0 ? '?' : character;
  std::string text = std::string(calibration_marker) + " from " + comment + ": " +
                     what_it_rests_on(calibration.noise) + ".\nsensor:\n";
  text += line("range_stddev", found.range_stddev, 6, "[m]");
  text += line("range_stddev_per_metre", found.range_stddev_per_metre, 6, "times the range");
  text += line("bearing_stddev", found.bearing_stddev, 6, "[rad]");
  text += line("flatness_stddev", found.flatness_stddev, 6, "[m]");
  if (calibration.bias) {
    const Interval& bias = calibration.bias->bias;
    text += line("range_bias_stddev", std::max(std::abs(bias.low), std::abs(bias.high)), 6,
                 "[m], as large as the bias that was measured");
  }
  return text;
}

nlohmann::ordered_json calibration_json(const Calibration& calibration) {
  const NoiseEstimate& noise = calibration.noise;
  nlohmann::ordered_json object{{"scans", noise.scans},
                                {"walls", noise.walls},
                                {"long_walls", noise.long_walls},
                                {"points", noise.points},
                                {"nearest", noise.nearest},
                                {"middle_range", noise.middle_range},
                                {"farthest", noise.farthest},
                                {"steepest_incidence", noise.steepest},
                                {"range_stddev", json_of(noise.range_stddev)},
                                {"range_stddev_per_metre", json_of(noise.range_stddev_per_metre)},
                                {"bearing_stddev", json_of(noise.bearing_stddev)},
                                {"flatness_stddev", json_of(noise.flatness_stddev)},
                                {"middle_range_stddev", json_of(noise.middle_range_stddev)},
                                {"interlace_stddev", json_of(noise.interlace_stddev)},
                                {"neighbour_correlation", json_of(noise.neighbour_correlation)},
                                {"quantization", noise.quantization},
                                {"reduced_chi_square", noise.reduced_chi_square},
                                {"refuted_walls", noise.refuted},
                                {"range_bias", nullptr},
                                {"by_range", json_of(noise.by_range)},
                                {"by_incidence", json_of(noise.by_incidence)},
                                {"missing", shortcomings(calibration)}};
  if (calibration.bias) object["range_bias"] = json_of(calibration.bias->bias);
  return object;
}

std::string calibration_page(const Calibration& calibration, const std::string& origin) {
  HtmlPage page("Noise of a 2D LiDAR", origin);
  page.heading(2, "Components");
  page.paragraph(what_it_rests_on(calibration.noise) + ".");
  HtmlTable table{{}, {"component", "meaning", "unit", "value", "95 %"}, {}, 3};
  for (const Row& row : rows_of(calibration)) {
    table.rows.push_back({row.name, row.meaning, row.unit,
                          fixed(row.scale * row.interval.value, row.digits), range_text(row)});
  }
  page.table(table);
  for (const std::string& text : shortcomings(calibration))
    page.paragraph("Missing: " + text + ".");
  page.heading(2, "Noise of ranges about the lines of walls");
  page.figure(plot("Noise over range", "range [m]", calibration.noise.by_range, 1.0),
              "Walls with more noise than the components say count half or less.");
  page.figure(plot("Noise over incidence", "angle of incidence [deg]",
                   calibration.noise.by_incidence, 180.0 / pi),
              "0 deg is head on.");
  return page.finish();
}

}  // namespace quoin::deploy
