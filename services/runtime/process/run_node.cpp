// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/run_node.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>

#include <spdlog/spdlog.h>

#include "services/deployment/deployment.hpp"
#include "services/runtime/node/local_topics.hpp"
#include "services/runtime/process/service.hpp"

namespace quoin::runtime {

namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds longest_wait{1000};
constexpr milliseconds pause_when_full{2};

/// Runs a node in the thread that calls run().
class NodeThread {
 public:
  NodeThread(Service& service, const KindInfo& kind, const PortTypes& types,
             const MethodFactory& make)
      : service_(service),
        kind_(kind),
        types_(types),
        node_({.service = service.config.name,
               .method = service.config.method,
               .parameters = service.config.parameters,
               .held = service.process.held},
              make, make_outputs(service, kind, types), service.data_thread()),
        answering_(service, node_.succession(),
                   [this](const msg::ControlRequest& request, msg::ControlReply& reply) {
                     node_.exchange().handle(request, reply);
                   }) {}
  ~NodeThread() {
    for (ReaderBase* reader : readers_) wait_set_.remove(*reader);
  }
  NodeThread(const NodeThread&) = delete;
  NodeThread& operator=(const NodeThread&) = delete;

  int run() {
    set_endpoint_report();
    // The inputs are opened once the outputs have their readers: so a whole deployment comes up
    // from its end to its sources, and the first scan finds everybody listening.
    if (service_.wait_for_readers(node_.outputs(), node_.succession())) work();
    for (const Node::OutputPart& part : node_.outputs()) {
      service_.pulse.wait_until(Clock::now() + longest_wait_for_acknowledgments);
      if (!part.output->wait_for_acknowledgments(longest_wait_for_acknowledgments)) {
        spdlog::warn("not all readers have acknowledged the last results");
      }
    }
    node_.leave();
    service_.process.heartbeat.finish(service_.record, msg::ServiceState::STATE_STOPPED);
    service_.record.set_endpoint_report(nullptr);
    return exit_ok;
  }

 private:
  void add(ReaderBase& reader) {
    wait_set_.add(reader);
    readers_.push_back(&reader);
  }
  void remove(ReaderBase& reader) {
    wait_set_.remove(reader);
    std::erase(readers_, &reader);
  }

  [[nodiscard]] Node::InputPart wired(const Connection& connection) {
    const InputPort& port = *kind_.input(connection.port);
    const ServiceConfig& writer = *connection.writer;
    const bool beside = share_memory(writer, service_.config);
    std::unique_ptr<Input> input;
    if (!beside || node_.succession().held()) {
      DdsInput made = types_.inputs[static_cast<std::size_t>(&port - kind_.inputs.data())](
          service_.process.participant, connection.output.topic,
          output_qos(writer, connection.output), writer.external() ? writer.name : "");
      add(*made.reader);
      input = beside ? std::make_unique<TakeOverInput>(
                           local(connection), std::move(made.input),
                           [this, reader = made.reader] { remove(*reader); })
                     : std::move(made.input);
    } else {
      input = local(connection);
    }
    return {port, writer.name, connection.output.topic, std::move(input)};
  }

  [[nodiscard]] std::unique_ptr<LocalInput> local(const Connection& connection) {
    const TopicQos qos = output_qos(*connection.writer, connection.output);
    return std::make_unique<LocalInput>(
        service_.process.topics.topic(connection.output.topic), label(service_.config),
        QueueLimit{queue_depth(qos.preset), qos.preset == QosPreset::lossless},
        [this] { wait_set_.wake(); });
  }

  [[nodiscard]] Node::InputPart observed(const Connection& connection) {
    const OutputConfig& output = connection.output;
    auto input = std::make_unique<ObservedInput>(
        service_.process.participant, output, observer_qos(*connection.writer, output),
        connection.writer->external() ? connection.writer->name : "");
    add(input->reader());
    return {{.name = output.topic, .type = output.type},
            connection.writer->name,
            output.topic,
            std::move(input)};
  }

  void open_inputs() {
    std::vector<Node::InputPart> parts;
    for (const Connection& connection : service_.process.graph.inputs_of(service_.config)) {
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
    // An instance that stands by, or is stood by for, asserts its liveliness; from this thread, so
    // that one whose method hangs is replaced.
    milliseconds timeout = longest_wait;
    if (service_.config.strength) timeout = service_.config.lease / 4;
    if (const auto due = node_.due()) {
      const auto left = std::chrono::ceil<milliseconds>(*due - Clock::now());
      timeout = std::clamp(left, milliseconds(0), timeout);
    }
    service_.pulse.wait_until(Clock::now() + timeout);
    const bool active = wait_set_.wait(timeout);
    if (!active && service_.config.strength) node_.assert_liveliness();
    bool any = false;
    while (!service_.stop.requested() && node_.step()) any = true;
    // What has no room stays with DDS, which goes on to say that there is something.
    if (active && !any && node_.full()) {
      (void)service_.stop.wait_until(Clock::now() + pause_when_full);
    }
  }

  Service& service_;
  const KindInfo& kind_;
  const PortTypes& types_;
  WaitSet wait_set_;                  // woken by the inputs of the node, too
  std::vector<ReaderBase*> readers_;  // that it waits for
  Node node_;
  Service::Answering answering_;  // by a thread that uses the node
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

Component node_component(const KindInfo& kind, PortTypes types, const MethodFactory& make) {
  return {&kind,
          [&kind, types = std::move(types), factory = checked(kind, make)](
              const Deployment&, const ServiceConfig& config) -> Component::Body {
            (void)factory(config.method, config.parameters);  // throws before DDS is touched
            return [&kind, &types, factory](Service& service) {
              return NodeThread(service, kind, types, factory).run();
            };
          }};
}

Component node_component(const KindInfo& kind, PortTypes types, OpenMethods open) {
  return {&kind,
          [&kind, types = std::move(types), open = std::move(open)](
              const Deployment& deployment, const ServiceConfig& config) -> Component::Body {
            return [&kind, &types, bind = opened(deployment, config, [&] {
                                     return open(deployment, config);
                                   })](Service& service) {
              return NodeThread(service, kind, types,
                                checked(kind, bind(service.process.participant)))
                  .run();
            };
          }};
}

}  // namespace quoin::runtime
