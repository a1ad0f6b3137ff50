// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "services/deployment/kind.hpp"
#include "services/runtime/node/dds_ports.hpp"
#include "services/runtime/node/method.hpp"

namespace quoin::runtime {

/// Turns one message into another; the header is the node's business. Returns the number of parts
/// (segments) that gave no result. An exception counts the message as lost in processing.
template <class In, class Out>
using Process = std::function<std::size_t(const In&, Out&)>;

/// The methods of a kind that turns one message into one other. `make` makes the process for a
/// method and its parameters; it throws ParameterError.
template <class In, class Out>
[[nodiscard]] MethodFactory stage(
    std::function<Process<In, Out>(const std::string& method, const ParameterSettings&)> make) {
  return [make = std::move(make)](const std::string& method, const ParameterSettings& parameters) {
    return Method{.handle = [process = make(method, parameters)](Work& work) {
      work.fail(process(work.input<In>(), work.output<Out>()));
    }};
  };
}

/// The main function of a service with one node: command line, deployment file, participant, ports,
/// accounting, heartbeat, control requests, orderly end. `types` are those of the kind's ports, in
/// their order. Returns the exit code: 0 stopped, 2 wrong configuration, 1 anything else.
int run_node(int argc, char** argv, const KindInfo& kind, const PortTypes& types,
             const MethodFactory& make);

/// The same for a kind with one input and one output.
template <class In, class Out>
int run_stage(int argc, char** argv, const KindInfo& kind,
              std::function<Process<In, Out>(const std::string&, const ParameterSettings&)> make) {
  return run_node(argc, argv, kind, port_types(Reads<In>(), Writes<Out>()),
                  stage<In, Out>(std::move(make)));
}

}  // namespace quoin::runtime
