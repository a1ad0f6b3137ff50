// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>

#include "services/runtime/process/run_node.hpp"
#include "tests/kinds/observer/kind.hpp"

using namespace quoin;

namespace {

runtime::Method make(const std::string&, const ParameterSettings&) {
  const auto counts = std::make_shared<std::map<std::string, std::size_t>>();
  return {.handle = [counts](runtime::Work& work) {
    const std::string& topic = work.input<runtime::ObservedMessage>().topic;
    work.set_diagnostic(topic, std::to_string(++(*counts)[topic]));
  }};
}

const runtime::Registration registration(runtime::node_component(
    tests::observer_kind(), runtime::port_types(runtime::Reads<>(), runtime::Writes<>()), make));

}  // namespace
