// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <idl/Corners.h>
#include <memory>
#include <stdexcept>
#include <thread>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/faulty/kind.hpp"

using namespace quoin;

namespace {

runtime::Method make(const std::string&, const ParameterSettings& settings) {
  const auto parameters = make_parameters<tests::FaultParameters>(settings);
  return {.handle = [parameters, count = std::make_shared<std::int64_t>(0)](runtime::Work& work) {
    ++*count;
    if (parameters.throw_every > 0 && *count % parameters.throw_every == 0) {
      throw std::runtime_error("this is one too many");
    }
    // Longer than a heartbeat tolerates.
    if (parameters.hang_at == *count) std::this_thread::sleep_for(std::chrono::seconds(14));
    work.output<msg::Corners>().corners(work.input<msg::Corners>().corners());
  }};
}

const runtime::Registration registration(runtime::node_component(
    tests::faulty_kind(),
    runtime::port_types(runtime::Reads<msg::Corners>(), runtime::Writes<msg::Corners>()), make));

}  // namespace
