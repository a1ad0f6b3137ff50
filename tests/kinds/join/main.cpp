// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Lines.h>
#include <idl/Scan.h>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/join/kind.hpp"

using namespace quoin;

namespace {

/// Which scans there were: "between" for one on each side of the stamp, "outside" when those on the
/// sides are not.
std::string mark(const runtime::Around<msg::Scan>& scan, std::int64_t stamp) {
  if (scan.before != nullptr && scan.before->header().stamp() > stamp) return "outside";
  if (scan.after != nullptr && scan.after->header().stamp() < stamp) return "outside";
  if (scan.before == nullptr && scan.after == nullptr) return "none";
  if (scan.after == nullptr) return "before";
  if (scan.before == nullptr) return "after";
  return scan.before == scan.after ? "same" : "between";
}

void handle(runtime::Work& work) {
  const auto& in = work.input<msg::Lines>();
  auto& out = work.output<msg::Lines>();
  out.sensor_model(in.sensor_model());
  out.lines(in.lines());
  out.failures(in.failures());
  out.covariance_mode(mark(work.around<msg::Scan>("scan"), in.header().stamp()));
}

const runtime::Registration registration(runtime::node_component(
    tests::join_kind(),
    runtime::port_types(runtime::Reads<msg::Lines, msg::Scan>(), runtime::Writes<msg::Lines>()),
    [](const std::string&, const ParameterSettings&) {
      return runtime::Method{.handle = handle};
    }));

}  // namespace
