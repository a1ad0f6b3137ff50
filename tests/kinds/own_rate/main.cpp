// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <functional>
#include <idl/Corners.h>
#include <memory>
#include <stdexcept>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/own_rate/kind.hpp"

using namespace quoin;

namespace {

/// The message has one corner, whose `first_line` is the count.
runtime::Method make(const std::string& method, const ParameterSettings& settings) {
  std::string form;
  for (const MethodInfo& info : tests::own_rate_kind().methods) {
    if (info.name == method) form = info.state;
  }
  const auto count = std::make_shared<std::uint32_t>(0);
  const auto parameters = make_parameters<tests::CounterParameters>(settings);
  return {.handle =
              [count, every = static_cast<std::uint32_t>(parameters.every)](runtime::Work& work) {
                ++*count;
                if (*count % every != 0) return;
                auto& out = work.output<msg::Corners>();
                out.covariance_mode("count");
                out.corners().resize(1);
                out.corners().front().first_line(*count);
                out.corners().front().covariance_xx(1e-4);
                out.corners().front().covariance_yy(1e-4);
                work.publish<msg::Corners>();
              },
          .state_form = form,
          .save =
              [count] {
                runtime::State state(sizeof *count);
                std::memcpy(state.data(), count.get(), sizeof *count);
                return state;
              },
          .restore =
              [count](const runtime::State& state) {
                if (state.size() != sizeof *count) throw std::invalid_argument("no count");
                std::memcpy(count.get(), state.data(), sizeof *count);
              }};
}

const runtime::Registration registration(runtime::node_component(
    tests::own_rate_kind(),
    runtime::port_types(runtime::Reads<msg::Corners>(), runtime::Writes<msg::Corners>()), make));

}  // namespace
