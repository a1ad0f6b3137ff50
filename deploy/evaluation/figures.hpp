// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "core/evaluation/consistency.hpp"
#include "core/evaluation/loop_coverage.hpp"
#include "core/geometry/angle.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/interval.hpp"
#include "deploy/evaluation/drawing/plot.hpp"

namespace quoin::deploy {

inline constexpr double degrees = 180.0 / pi;  ///< in a radian

/// Adds `name` and `name`_interval to a JSON object.
void add_interval(nlohmann::ordered_json& object, const std::string& name,
                  const Interval& interval);

/// [low, high]
[[nodiscard]] nlohmann::ordered_json interval_json(const Interval& interval);

/// The failures that occurred, by name.
[[nodiscard]] nlohmann::ordered_json failures_json(const FailureCounts& failures);
/// The same for the eye, "-" for none.
[[nodiscard]] std::string failures_text(const FailureCounts& failures);

/// What the figures of a LoopCoverage mean.
inline constexpr const char* loop_coverage_text =
    "Each found corner is held against the nearest true one, partitions that end on a wall and "
    "walls that cross included; one near none is false. Recall is of the true corners whose two "
    "walls are seen with 0.3 m and 8 points up to the corner, precision is the share of true ones "
    "among the found ones, coverage and NEES are of those, NEES of the ones within four sigma. "
    "Lines are judged from 0.3 m on.";

/// Recall, precision and coverage of corners, and coverage of lines.
void add_loop_coverage(nlohmann::ordered_json& object, const LoopCoverage& result);

/// A figure that a paper prints beside what was measured here.
struct PublishedComparison {
  std::string paper;
  std::string place;  ///< table, figure or equation
  std::string quantity;
  std::string unit;
  double published = 0.0;
  std::optional<double> measured;  ///< nothing when it was not found
};

/// Adds an entry to the report's array `published`.
void add_published(nlohmann::ordered_json& report, const PublishedComparison& comparison);

/// "value [low, high]" times `factor`.
[[nodiscard]] std::string interval_text(const Interval& interval, int digits, double factor = 1.0);
[[nodiscard]] PlottedInterval plotted(const Interval& interval, double factor = 1.0);

/// Of corners inside their 95 % ellipses [%], with 95 % marked, still without values.
[[nodiscard]] IntervalChart coverage_chart(const std::string& where);

/// Such as "50 mm, 0.391 deg".
[[nodiscard]] std::string noise_text(const SensorModel& noise);

/// Noise of the ranges with the bearing noise of the RPLIDAR S1, 0.113 deg.
[[nodiscard]] SensorModel rplidar_noise(double range_stddev);

}  // namespace quoin::deploy
