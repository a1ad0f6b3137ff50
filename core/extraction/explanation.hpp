// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/extraction/method_chain.hpp"
#include "core/segmentation/trace.hpp"
#include "core/sensor/points.hpp"
#include "core/sensor/scan.hpp"

namespace quoin {

/// Where a line is missed: at a point, or in the direction of a bearing.
struct Place {
  double bearing = 0.0;                        ///< [rad]
  std::optional<double> range = std::nullopt;  ///< [m]; nothing: along the bearing

  [[nodiscard]] static Place at(double x, double y);
};

/// A parameter, and the value nearest to its own with which the points become a line (or a pair of
/// lines a corner). Found by running the method with it.
struct Remedy {
  std::string parameter;
  std::string unit;
  double value = 0.0;
  double would = 0.0;
  /// With this alone the step does not decide any more, but a later one does.
  bool first_of_several = false;
};

/// A neighbouring line with which the line has no corner.
struct MissingCorner {
  std::size_t line = 0;  ///< index of the neighbour among the lines
  std::string reason;    ///< name of a NoCornerReason
  std::vector<Remedy> remedies;
};

struct Explanation {
  bool measured = false;  ///< a ray came back there
  double x = 0.0;         ///< [m] of the measured point nearest to the place
  double y = 0.0;         ///< [m]
  double distance =
      0.0;  ///< [m] of it from the place, or along the bearing [rad] where no range is asked for
  std::size_t points = 0;          ///< neighbours of it with the same outcome, itself included
  std::size_t surface_points = 0;  ///< points up to the gaps on both sides
  double extent = 0.0;             ///< [m] from the first to the last of `points`
  PointOutcome outcome = PointOutcome::no_line;
  std::vector<Remedy> remedies;     ///< for what is not of a segment; the nearest first
  std::string fit_failure;          ///< of the segment; "" when it has a line
  std::optional<std::size_t> line;  ///< index of it among the lines
  std::size_t corners = 0;          ///< of that line
  std::vector<MissingCorner> missing_corners;
};

/// Why there is a line at a place of a scan, or none, and whether it has corners. Runs the methods
/// with the parameters changed one at a time, some hundred times. Throws ParameterError when the
/// chain cannot be made.
[[nodiscard]] Explanation explain(const ScanView& scan, const SensorModel& sensor,
                                  const MethodChain& chain, const Place& place);

}  // namespace quoin
