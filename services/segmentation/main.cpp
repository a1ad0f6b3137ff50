// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

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
  std::size_t cut_short = 0;  // scans
};

runtime::Method make(const std::string& method, const ParameterSettings& parameters) {
  auto space = std::make_shared<Workspace>();
  space->segment = Segmenters::make<Segmenter>(method, parameters);
  return {.handle = [space](runtime::Work& work) {
    const msg::Scan& scan = work.input<msg::Scan>();
    convert({scan.bearings(), scan.ranges(), scan.range_min(), scan.range_max()}, space->points);
    space->segment(space->points, topics::sensor_model(scan.sensor_model()), space->found);
    if (space->found.cut_short) {
      work.set_diagnostic("Scans Cut Short", std::to_string(++space->cut_short));
    }
    set_aside(space->points, space->found);
    topics::fill_segments(scan, space->points, space->found, work.output<msg::Segments>());
    if (space->found.segments.empty()) work.fail(1);  // a scan without any line is counted
  }};
}

const runtime::Registration registration(runtime::node_component(
    segmentation_kind(),
    runtime::port_types(runtime::Reads<msg::Scan>(), runtime::Writes<msg::Segments>()), make));

}  // namespace
