// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <idl/Corners.h>
#include <memory>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/sink/kind.hpp"

using namespace quoin;

namespace {

runtime::Method make(const std::string&, const ParameterSettings&) {
  return {.handle = [corners = std::make_shared<std::size_t>(0)](runtime::Work& work) {
    *corners += work.input<msg::Corners>().corners().size();
    work.set_diagnostic("corners", std::to_string(*corners));
  }};
}

const runtime::Registration registration(runtime::node_component(
    tests::sink_kind(), runtime::port_types(runtime::Reads<msg::Corners>(), runtime::Writes<>()),
    make));

}  // namespace
