// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/run_node.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include <spdlog/spdlog.h>

#include "services/deployment/graph.hpp"
#include "services/runtime/node/node.hpp"
#include "services/runtime/process/control.hpp"
#include "services/runtime/process/service.hpp"

namespace quoin::runtime {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds longest_wait{1000};
constexpr milliseconds pause_when_full{2};

/// Runs one node in the thread that calls run().
class NodeProcess {
 public:
  NodeProcess(Service& service, const KindInfo& kind, const PortTypes& types,
              const MethodFactory& make)
      : service_(service),
        kind_(kind),
        types_(types),
        node_({.service = service.config.name,
               .method = service.config.method,
               .parameters = service.config.parameters,
               .held = service.held},
              make, make_outputs(service, kind, types), service.data_thread()),
        control_(service, node_.succession(),
                 [this](const msg::ControlRequest& request, msg::ControlReply& reply) {
                   node_.exchange().handle(request, reply);
                 }) {}

  int run() {
    set_endpoint_report();
    // The inputs are opened once the outputs have their readers: so a whole deployment comes up
    // from its end to its sources, and the first scan finds everybody listening.
    std::vector<const Output*> waiting;
    for (const Node::OutputPart& part : node_.outputs()) waiting.push_back(part.output.get());
    if (service_.wait_for_readers(waiting, node_.succession())) work();
    service_.heartbeat.stopping();
    for (const Node::OutputPart& part : node_.outputs()) {
      if (!part.output->wait_for_acknowledgments(longest_wait_for_acknowledgments)) {
        spdlog::warn("not all readers have acknowledged the last results");
      }
    }
    node_.leave();
    service_.heartbeat.finish(msg::ServiceState::STATE_STOPPED);
    service_.record.set_endpoint_report(nullptr);
    return exit_ok;
  }

 private:
  [[nodiscard]] Node::InputPart wired(const Connection& connection) {
    const InputPort& port = *kind_.input(connection.port);
    const ServiceConfig& writer = *connection.writer;
    DdsInput made = types_.inputs[static_cast<std::size_t>(&port - kind_.inputs.data())](
        service_.participant, connection.output.topic, output_qos(writer, connection.output),
        writer.external() ? writer.name : "");
    wait_set_.add(*made.reader);
    return {port, writer.name, connection.output.topic, std::move(made.input)};
  }

  [[nodiscard]] Node::InputPart observed(const Connection& connection) {
    const OutputConfig& output = connection.output;
    auto input = std::make_unique<ObservedInput>(
        service_.participant, output, observer_qos(*connection.writer, output),
        connection.writer->external() ? connection.writer->name : "");
    wait_set_.add(input->reader());
    return {{.name = output.topic, .type = output.type},
            connection.writer->name,
            output.topic,
            std::move(input)};
  }

  void open_inputs() {
    std::vector<Node::InputPart> parts;
    for (const Connection& connection : service_.graph.inputs_of(service_.config)) {
      parts.push_back(kind_.observer ? observed(connection) : wired(connection));
    }
    // The heartbeat asks the node for its ports.
    service_.record.set_endpoint_report(nullptr);
    node_.open(std::move(parts));
    set_endpoint_report();
  }

  void set_endpoint_report() {
    service_.record.set_endpoint_report(
        [this](msg::ServiceStatus& status) { node_.report_endpoints(status); });
  }

  void work() {
    open_inputs();
    service_.stop.on_request([&] { wait_set_.wake(); });
    node_.succession().on_request([&] { wait_set_.wake(); });
    if (get_ready()) {
      while (!service_.stop.requested() && !node_.has_left()) turn();
      if (!node_.has_left() && !node_.succession().held()) node_.drain();
    }
    node_.succession().on_request(nullptr);
    service_.stop.on_request(nullptr);
  }

  /// False when it is to stop instead.
  bool get_ready() {
    if (!node_.succession().held()) {
      service_.record.set_state(msg::ServiceState::STATE_ACTIVE);
      return true;
    }
    service_.record.set_state(msg::ServiceState::STATE_STARTING, "waiting for its input");
    while (node_.matched_writers() == 0) {
      if (!service_.stop.wait_until(Clock::now() + milliseconds(20))) return false;
    }
    service_.record.set_state(msg::ServiceState::STATE_HELD);
    return true;
  }

  void turn() {
    // An instance that stands by, or is stood by for, tells that it lives; from this thread, so
    // that one whose method hangs is replaced.
    milliseconds timeout = longest_wait;
    if (service_.config.strength) timeout = service_.config.lease / 4;
    if (const auto due = node_.due()) {
      const auto left = std::chrono::ceil<milliseconds>(*due - Clock::now());
      timeout = std::clamp(left, milliseconds(0), timeout);
    }
    service_.heartbeat.pulse().wait_until(Clock::now() + timeout);
    const bool active = wait_set_.wait(timeout);
    if (!active && service_.config.strength) node_.assert_liveliness();
    bool any = false;
    while (node_.step()) any = true;
    // What has no room stays with DDS, which goes on to say that there is something.
    if (active && !any && node_.full()) {
      (void)service_.stop.wait_until(Clock::now() + pause_when_full);
    }
  }

  Service& service_;
  const KindInfo& kind_;
  const PortTypes& types_;
  Node node_;
  ControlServer control_;  // its threads use the node
  WaitSet wait_set_;
};

/// Methods that fit what the kind says of itself, which `quoin check` and `quoin apply` go by.
MethodFactory checked(const KindInfo& kind, const MethodFactory& make) {
  return [&kind, make](const std::string& name, const ParameterSettings& settings) {
    if (kind.methods.empty()) {
      if (!name.empty()) throw ParameterError("method", "kind " + kind.name + " has no methods");
      check_parameters(kind.parameters, settings);
    }
    Method method = make(name, settings);
    for (const MethodInfo& info : kind.methods) {
      if (info.name != name || info.state == method.state_form) continue;
      throw std::logic_error("method " + name + " of kind " + kind.name + " keeps the state '" +
                             method.state_form + "', but is described to keep '" + info.state +
                             "'");
    }
    return method;
  };
}

}  // namespace

int run_node(int argc, char** argv, const KindInfo& kind, const PortTypes& types,
             const MethodFactory& make) {
  const MethodFactory factory = checked(kind, make);
  return run_service(
      argc, argv, kind,
      [&](const Deployment&, const ServiceConfig& config) {
        (void)factory(config.method, config.parameters);  // throws before DDS is touched
      },
      [&](Service& service) { return NodeProcess(service, kind, types, factory).run(); });
}

}  // namespace quoin::runtime
