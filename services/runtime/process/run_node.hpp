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
#include "services/runtime/process/run_process.hpp"

namespace quoin::runtime {

/// Turns one message into another; the header is the node's business. Returns the number of parts
/// (segments) that gave no result. An exception counts the message as lost in processing.
template <class In, class Out>
using Handler = std::function<std::size_t(const In&, Out&)>;

/// A kind whose services are nodes. `types` are those of the kind's ports, in their order.
[[nodiscard]] Component node_component(const KindInfo& kind, PortTypes types,
                                       const MethodFactory& make);

/// The same for a kind whose methods write or read topics of their own, too. `open` looks at the
/// service before DDS is touched; its exceptions are errors of the deployment file. What it returns
/// makes the methods once there is a participant, which outlives them.
using BindMethods = std::function<MethodFactory(Participant&)>;
using OpenMethods = std::function<BindMethods(const Deployment&, const ServiceConfig&)>;
[[nodiscard]] Component node_component(const KindInfo& kind, PortTypes types, OpenMethods open);

/// The same for a kind that turns one message into one other. `make` makes the handler for a method
/// and its parameters; it throws ParameterError.
template <class In, class Out>
[[nodiscard]] Component stage_component(
    const KindInfo& kind,
    std::function<Handler<In, Out>(const std::string& method, const ParameterSettings&)> make) {
  return node_component(
      kind, port_types(Reads<In>(), Writes<Out>()),
      [make = std::move(make)](const std::string& method, const ParameterSettings& parameters) {
        return Method{.handle = [handle = make(method, parameters)](Work& work) {
          work.fail(handle(work.input<In>(), work.output<Out>()));
        }};
      });
}

}  // namespace quoin::runtime
