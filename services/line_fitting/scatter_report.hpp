// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <idl/Segments.h>
#include <string>
#include <utility>

#include "core/fitting/fit.hpp"
#include "core/fitting/line_difference.hpp"
#include "core/sensor/points.hpp"
#include "core/statistics/line_scatter.hpp"
#include "services/runtime/node/method.hpp"

namespace quoin {

/// Says in the heartbeat how much the lines of the last minute scatter by what the sensor model
/// says. One wall of each message, one after the other, is fitted by its odd and its even points,
/// too.
class ScatterReport {
 public:
  explicit ScatterReport(Fitter fitter) : fitter_(std::move(fitter)) {}

  /// A message, and its sensor model for fits.
  void begin(const msg::Segments& segments, const SensorModel& sensor) {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    now_ = now.count();
    // Lines that another model judges say nothing of this one.
    if (!(segments.sensor_model() == model_)) scatter_.clear();
    model_ = segments.sensor_model();
    flat_ = sensor;
    flat_.flatness_stddev = 0.0;  // which odd and even points share
    ++messages_;
    split_ = segments.segments().empty() ? 0 : messages_ % segments.segments().size();
  }

  /// The line of segment `index`.
  void add(std::size_t index, const PointsView& points, double chi_square) {
    scatter_.add(now_, chi_square, points.size());
    if (index != split_ || points.size() < 20) return;
    const auto squared = odd_even_squared(fitter_, points, flat_, scratch_);
    if (squared) scatter_.add_split(now_, *squared);
  }

  void report(runtime::Work& work) {
    if (now_ < reported_ + 1.0) return;
    reported_ = now_;
    work.set_diagnostic(std::string(line_scatter_diagnostic), to_text(scatter_.scatter(now_)));
  }

 private:
  Fitter fitter_;
  RunningScatter scatter_;
  msg::SensorModel model_;
  SensorModel flat_;
  Points scratch_;
  double now_ = 0.0;  // [s]
  double reported_ = 0.0;
  std::size_t messages_ = 0;
  std::size_t split_ = 0;  // the segment that is split
};

}  // namespace quoin
