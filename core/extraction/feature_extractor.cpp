// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/extraction/feature_extractor.hpp"

#include <stdexcept>
#include <string>

#include "core/corners/corner_finders.hpp"
#include "core/fitting/fitters.hpp"
#include "core/segmentation/segmenters.hpp"
#include "core/sensor/sensor_fields.hpp"

namespace quoin {
namespace {

/// What `make` returns; its errors name the owner of the parameter.
template <class Make>
auto named_errors(const std::string& owner, Make make) {
  try {
    return make();
  } catch (const ParameterError& error) {
    throw ParameterError(error.parameter(), owner + ": " + error.parameter() + ": " + error.what());
  }
}

template <class Function, class Methods>
Function method_of(const char* concept_name, const MethodChoice& choice) {
  return named_errors(std::string(concept_name) + " '" + choice.method + "'", [&] {
    return Methods::template make<Function>(choice.method, choice.settings);
  });
}

SensorModel checked(const SensorModel& sensor) {
  detail::SensorParameters parameters;
  static_cast<SensorModel&>(parameters) = sensor;
  named_errors("sensor", [&] {
    check_parameters(sensor_parameters(), parameter_settings(parameters));
    return 0;
  });
  return sensor;
}

}  // namespace

FeatureExtractor::FeatureExtractor(const SensorModel& sensor, const MethodChain& methods,
                                   std::size_t alignment_of_lines)
    : sensor_(checked(sensor)),
      extraction_(method_of<Segmenter, Segmenters>("segmenter", methods.segmenter),
                  method_of<Fitter, Fitters>("fitter", methods.fitter),
                  method_of<CornerFinder, CornerFinders>("corner finder", methods.finder)) {
  if (alignment_of_lines == alignof(LineSegment)) return;
  const std::string own = std::to_string(alignof(LineSegment));
  throw std::logic_error("Eigen aligns matrices to " + std::to_string(alignment_of_lines) +
                         " bytes in this program and to " + own +
                         " in the library quoin; compile both for the same processors (-march), or "
                         "the program with -DEIGEN_MAX_STATIC_ALIGN_BYTES=" +
                         own);
}

Features FeatureExtractor::operator()(const ScanView& scan) {
  extraction_.run(scan, sensor_, sensor_);
  return {extraction_.points().view(), extraction_.segments(), extraction_.arcs(),
          extraction_.lines(),         extraction_.fitted(),   extraction_.failures(),
          extraction_.corners()};
}

}  // namespace quoin
