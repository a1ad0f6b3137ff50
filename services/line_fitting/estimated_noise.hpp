// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <idl/Lines.h>
#include <idl/Segments.h>
#include <string>
#include <vector>

#include "core/calibration/running_noise.hpp"
#include "core/sensor/points.hpp"
#include "services/topics/header.hpp"
#include "services/topics/segments.hpp"

namespace quoin {

/// The noise that lines are fitted with: what the source declares or, where it asks for that, what
/// its last scans show.
class EstimatedNoise {
 public:
  /// For this message; the bias of ranges is always as declared.
  [[nodiscard]] SensorModel model_for(const msg::Segments& in) {
    // What another source, or the same one otherwise, declares begins anew.
    if (!(in.sensor_model() == declared_)) *this = EstimatedNoise(in.sensor_model());
    SensorModel model = topics::sensor_model(declared_);
    if (!declared_.estimated() || !noise_.components()) return model;
    const double bias = model.range_bias_stddev;
    model = noise_.components()->model();
    model.range_bias_stddev = bias;
    return model;
  }

  /// Says in the lines which model they were fitted with.
  void declare(const msg::Segments& in, const SensorModel& model, msg::Lines& out) const {
    out.sensor_model(topics::sensor_model_message(model));
    out.sensor_model().estimated(in.sensor_model().estimated() && noise_.components().has_value());
  }

  /// Takes what a message shows of the noise; nothing where it is declared. Sets what is new as
  /// diagnostics of `work`, which is a runtime::Work.
  template <class Work>
  void add(const msg::Segments& in, const PointsView& points, Work& work) {
    if (!declared_.estimated()) return;
    walls_.clear();
    for (const msg::IndexRange& wall : in.segments()) walls_.push_back({wall.begin(), wall.end()});
    const RunningNoise::Event event = noise_.add(points, walls_);
    if (event == RunningNoise::Event::none) return;
    work.set_diagnostic("Noise", to_text(*noise_.components()));
    if (event != RunningNoise::Event::jump) return;
    ++jumps_;
    work.set_diagnostic("Noise Jumps", std::to_string(jumps_) + ", the last at scan " +
                                           std::to_string(topics::sequence_number(in.header())));
  }

  EstimatedNoise() = default;

 private:
  static std::string to_text(const NoiseComponents& found) {
    const auto text = [](double value, const char* unit) {
      std::string digits = std::to_string(1e3 * value);
      digits.resize(digits.find('.') + 4);
      return digits + unit;
    };
    return "range " + text(found.range_stddev, " mm") + ", growing " +
           text(found.range_stddev_per_metre, " mm/m") + ", bearing " +
           text(found.bearing_stddev, " mrad") + ", flatness " + text(found.flatness_stddev, " mm");
  }

  explicit EstimatedNoise(const msg::SensorModel& declared) : declared_(declared) {}

  msg::SensorModel declared_;
  RunningNoise noise_;
  std::vector<Segment> walls_;
  std::size_t jumps_ = 0;
};

}  // namespace quoin
