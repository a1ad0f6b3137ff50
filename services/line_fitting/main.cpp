// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "core/fitting/fitters.hpp"
#include "services/line_fitting/estimated_noise.hpp"
#include "services/line_fitting/kind.hpp"
#include "services/line_fitting/scatter_report.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/topics/lines.hpp"
#include "services/topics/segments.hpp"

using namespace quoin;

namespace {

runtime::Method make(const std::string& method, const ParameterSettings& parameters) {
  const auto fit = Fitters::make<Fitter>(method, parameters);
  const std::string mode = Fitters::setting(method, parameters, "covariance");
  const bool propagated = mode == enum_name(CovarianceMode::propagated);
  auto points = std::make_shared<Points>();
  auto scatter = std::make_shared<ScatterReport>(fit);
  auto noise = std::make_shared<EstimatedNoise>();
  return {.handle = [fit, mode, propagated, points, scatter, noise](runtime::Work& work) {
    const msg::Segments& in = work.input<msg::Segments>();
    msg::Lines& out = work.output<msg::Lines>();
    convert_ordered(in.bearings(), in.ranges(), *points);
    const SensorModel sensor = noise->model_for(in);
    noise->declare(in, sensor, out);
    out.covariance_mode(mode);
    out.lines().clear();
    out.failures().clear();
    scatter->begin(in, sensor);
    for (std::uint32_t i = 0; i < in.segments().size(); ++i) {
      const PointsView segment =
          points->view().subview(in.segments()[i].begin(), in.segments()[i].end());
      const FitResult result = fit(segment, sensor);
      if (result.ok()) {
        const double residuals = chi_square(result.estimate.line, segment, sensor);
        const LineSegment line = propagated ? true_segment(result, segment, sensor, residuals)
                                            : line_segment(result.estimate, result.normal, segment);
        scatter->add(i, segment, residuals);
        topics::append_line(line, residuals, i, out);
      } else {
        topics::append_failure(result.failure, i, out);
      }
    }
    scatter->report(work);
    noise->add(in, *points, work);
    work.fail(out.failures().size());
  }};
}

const runtime::Registration registration(runtime::node_component(
    line_fitting_kind(),
    runtime::port_types(runtime::Reads<msg::Segments>(), runtime::Writes<msg::Lines>()), make));

}  // namespace
