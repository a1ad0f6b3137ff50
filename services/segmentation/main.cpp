// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "core/segmentation/segmenters.hpp"
#include "core/sensor/scan.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/segmentation/kind.hpp"
#include "services/topics/segments.hpp"

using namespace quoin;

namespace {

struct Workspace {
  Segmenter segment;
  Points points;
  Segmentation found;
};

runtime::Handler<msg::Scan, msg::Segments> make(const std::string& method,
                                                const ParameterSettings& parameters) {
  auto work = std::make_shared<Workspace>();
  work->segment = Segmenters::make<Segmenter>(method, parameters);
  return [work](const msg::Scan& scan, msg::Segments& out) -> std::size_t {
    convert({scan.bearings(), scan.ranges(), scan.range_min(), scan.range_max()}, work->points);
    work->segment(work->points, topics::sensor_model(scan.sensor_model()), work->found);
    set_aside(work->points, work->found);
    topics::fill_segments(scan, work->points, work->found, out);
    return work->found.segments.empty() ? 1 : 0;  // a scan without any line is counted
  };
}

const runtime::Registration registration(
    runtime::stage_component<msg::Scan, msg::Segments>(segmentation_kind(), make));

}  // namespace
