// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "core/corners/corner_finders.hpp"
#include "services/corner_estimation/kind.hpp"
#include "services/runtime/process/run_node.hpp"
#include "services/topics/corners.hpp"
#include "services/topics/lines.hpp"

using namespace quoin;

namespace {

struct Workspace {
  CornerFinder find;
  std::vector<LineSegment> lines;
  FoundCorners corners;
};

runtime::Handler<msg::Lines, msg::Corners> make(const std::string& method,
                                                const ParameterSettings& parameters) {
  auto work = std::make_shared<Workspace>();
  work->find = CornerFinders::make<CornerFinder>(method, parameters);
  return [work](const msg::Lines& in, msg::Corners& out) -> std::size_t {
    topics::line_segments(in, work->lines);
    work->find(work->lines, in.sensor_model().range_bias_stddev(), work->corners);
    topics::fill_corners(work->corners, in.covariance_mode(), out);
    return 0;
  };
}

const runtime::Registration registration(
    runtime::stage_component<msg::Lines, msg::Corners>(corner_estimation_kind(), make));

}  // namespace
