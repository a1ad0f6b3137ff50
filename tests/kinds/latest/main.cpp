// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Corners.h>
#include <idl/Scan.h>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/latest/kind.hpp"

using namespace quoin;

namespace {

/// The mark is "none" while there are no corners.
runtime::Method make(const std::string&, const ParameterSettings&) {
  return {.handle = [](runtime::Work& work) {
    auto& out = work.output<msg::Corners>();
    const auto* corners = work.latest<msg::Corners>("corners");
    out.covariance_mode(corners == nullptr ? "none" : corners->covariance_mode());
    out.corners().clear();
    if (corners != nullptr) out.corners(corners->corners());
  }};
}

const runtime::Registration registration(runtime::node_component(
    tests::latest_kind(),
    runtime::port_types(runtime::Reads<msg::Scan, msg::Corners>(), runtime::Writes<msg::Corners>()),
    make));

}  // namespace
