// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "core/circles/circle_fitters.hpp"
#include "services/circle_fitting/kind.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/topics/circles.hpp"
#include "services/topics/segments.hpp"

using namespace quoin;

namespace {

runtime::Handler<msg::Segments, msg::Circles> make(const std::string& method,
                                                   const ParameterSettings& parameters) {
  const auto fit = CircleFitters::make<CircleFitter>(method, parameters);
  auto points = std::make_shared<Points>();
  return [fit, points](const msg::Segments& in, msg::Circles& out) {
    const SensorModel sensor = topics::sensor_model(in.sensor_model());
    convert_ordered(in.bearings(), in.ranges(), *points);
    out.sensor_model(in.sensor_model());
    out.circles().clear();
    out.failures().clear();
    for (std::uint32_t i = 0; i < in.arcs().size(); ++i) {
      const PointsView arc = points->view().subview(in.arcs()[i].begin(), in.arcs()[i].end());
      CircleFit result = fit(arc, sensor);
      scale_to_residuals(result, arc.size());
      topics::append_circle(result, arc, i, out);
    }
    return out.failures().size();
  };
}

const runtime::Registration registration(
    runtime::stage_component<msg::Segments, msg::Circles>(circle_fitting_kind(), make));

}  // namespace
