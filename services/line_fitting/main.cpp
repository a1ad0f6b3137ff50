// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <stdexcept>

#include "core/fitting/fitters.hpp"
#include "services/line_fitting/kind.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/topics/lines.hpp"
#include "services/topics/segments.hpp"

using namespace quoin;

namespace {

runtime::Handler<msg::Segments, msg::Lines> make(const std::string& method,
                                                 const ParameterSettings& parameters) {
  const auto fit = Fitters::make<Fitter>(method, parameters);
  const std::string mode = Fitters::setting(method, parameters, "covariance");
  const bool scales = mode == enum_name(CovarianceMode::propagated);
  auto points = std::make_shared<Points>();
  return [fit, mode, scales, points](const msg::Segments& in, msg::Lines& out) {
    if (!topics::valid(in)) throw std::invalid_argument("index ranges outside the points");
    const SensorModel sensor = topics::sensor_model(in.sensor_model());
    convert_ordered(in.bearings(), in.ranges(), *points);
    out.sensor_model(in.sensor_model());
    out.covariance_mode(mode);
    out.lines().clear();
    out.failures().clear();
    for (std::uint32_t i = 0; i < in.segments().size(); ++i) {
      const PointsView segment =
          points->view().subview(in.segments()[i].begin(), in.segments()[i].end());
      FitResult result = fit(segment, sensor);
      if (result.ok()) {
        const double residuals = chi_square(result.estimate.line, segment, sensor);
        if (scales) scale_to_residuals(result.estimate, residuals, segment.size());
        LineSegment line = line_segment(result.estimate, result.normal, segment);
        if (scales) add_flatness(line, sensor.flatness_stddev);
        topics::append_line(line, residuals, i, out);
      } else {
        topics::append_failure(result.failure, i, out);
      }
    }
    return out.failures().size();
  };
}

const runtime::Registration registration(
    runtime::stage_component<msg::Segments, msg::Lines>(line_fitting_kind(), make));

}  // namespace
