// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/figures.hpp"

#include "deploy/evaluation/drawing/svg.hpp"
#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

/// Calls `report` with the name and the count of each failure that occurred.
template <class Function>
void for_each_failure(const FailureCounts& failures, const Function& report) {
  for (const auto& [failure, name] : EnumNames<FitFailure>::names) {
    const std::size_t count = failures[static_cast<std::size_t>(failure)];
    if (failure != FitFailure::none && count > 0) report(std::string(name), count);
  }
}

}  // namespace

nlohmann::ordered_json interval_json(const Interval& interval) {
  return nlohmann::ordered_json::array({interval.low, interval.high});
}

void add_interval(nlohmann::ordered_json& object, const std::string& name,
                  const Interval& interval) {
  object[name] = interval.value;
  object[name + "_interval"] = interval_json(interval);
}

nlohmann::ordered_json failures_json(const FailureCounts& failures) {
  auto object = nlohmann::ordered_json::object();
  for_each_failure(failures,
                   [&](const std::string& name, std::size_t count) { object[name] = count; });
  return object;
}

std::string failures_text(const FailureCounts& failures) {
  std::string text;
  for_each_failure(failures, [&](const std::string& name, std::size_t count) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  });
  return text.empty() ? "-" : text;
}

void add_loop_coverage(nlohmann::ordered_json& object, const LoopCoverage& result) {
  const CornerQuality& corners = result.corners;
  object["true_corners"] = corners.true_corners;
  object["found_corners"] = corners.found_corners;
  object["false_corners"] = corners.false_corners;
  add_interval(object, "recall", corners.recall);
  add_interval(object, "precision", corners.precision);
  add_interval(object, "coverage95", corners.coverage);
  add_interval(object, "nees", corners.nees);
  object["beyond_four_sigma"] = corners.beyond_four_sigma;
  object["lines"] = result.lines.lines;
  object["false_lines"] = result.lines.false_lines;
  add_interval(object, "line_coverage95", result.lines.coverage);
  object["lines_beyond_four_sigma"] = result.lines.beyond_four_sigma;
}

void add_published(nlohmann::ordered_json& report, const PublishedComparison& comparison) {
  nlohmann::ordered_json entry{{"paper", comparison.paper},         {"place", comparison.place},
                               {"quantity", comparison.quantity},   {"unit", comparison.unit},
                               {"published", comparison.published}, {"measured", nullptr}};
  if (comparison.measured) entry["measured"] = *comparison.measured;
  report["published"].push_back(std::move(entry));
}

std::string interval_text(const Interval& interval, int digits, double factor) {
  return fixed(interval.value * factor, digits) + " [" + fixed(interval.low * factor, digits) +
         ", " + fixed(interval.high * factor, digits) + "]";
}

PlottedInterval plotted(const Interval& interval, double factor) {
  return {interval.value * factor, interval.low * factor, interval.high * factor};
}

IntervalChart coverage_chart(const std::string& where) {
  IntervalChart chart;
  chart.title = "Coverage of the 95 % ellipses, " + where;
  chart.x.title = "corners inside their ellipse [%]";
  chart.reference = 95.0;
  chart.reference_name = "95 %";
  return chart;
}

std::string noise_text(const SensorModel& noise) {
  std::string text = number(noise.range_stddev * 1e3, 1) + " mm";
  if (noise.range_stddev_per_metre > 0.0) {
    text += " and " + number(noise.range_stddev_per_metre * 1e3, 1) + " mm/m";
  }
  text += ", " + number(noise.bearing_stddev * degrees, 3) + " deg";
  if (noise.flatness_stddev > 0.0) {
    text += ", walls flat to " + number(noise.flatness_stddev * 1e3, 1) + " mm";
  }
  return text;
}

SensorModel rplidar_noise(double range_stddev) {
  SensorModel noise;
  noise.range_stddev = range_stddev;
  return noise;
}

}  // namespace quoin::deploy
