// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/deployment/graph.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/node/dds_ports.hpp"
#include "services/runtime/node/local_topics.hpp"
#include "services/runtime/node/node.hpp"
#include "services/runtime/node/service_record.hpp"
#include "services/runtime/process/control.hpp"
#include "services/runtime/process/heartbeat.hpp"
#include "services/runtime/process/stop_signal.hpp"

namespace quoin::runtime {

/// What the services of a process share.
struct Process {
  Graph graph;
  Participant participant;
  LocalTopics topics;
  Heartbeat heartbeat;
  ControlServer control;
  /// How long to wait for readers that are not there.
  std::chrono::duration<double> longest_wait_for_readers;
  bool held;  ///< to take over from another process of the services

  /// `user_data`: of the participant.
  Process(const Deployment& deployment, const std::string& name,
          const std::vector<const ServiceConfig*>& services,
          std::chrono::duration<double> wait_for_readers, bool to_take_over,
          std::string user_data = {});
};

/// A service of a process; its work is done in a thread of its own.
struct Service {
  Process& process;
  const ServiceConfig& config;
  Stop stop;
  ServiceRecord record;
  Pulse pulse;
  /// Readers of all outputs to wait for before the inputs are opened.
  std::size_t expected_readers;
  /// It has published all there is, as a finite source does, not because it was asked to stop.
  bool finished = false;

  /// `observers`: readers outside the deployment to wait for.
  Service(Process& process_of_it, const ServiceConfig& service_config, std::size_t observers);

  [[nodiscard]] DataThread data_thread() {
    return {record, pulse, [this] { return stop.requested(); }};
  }
  /// Answers control requests until the result is destroyed.
  class Answering {
   public:
    Answering(Service& service, Succession& succession, ControlTarget::Handler handler);
    ~Answering();
    Answering(const Answering&) = delete;
    Answering& operator=(const Answering&) = delete;

   private:
    Service& service_;
  };

  /// Waits until the outputs have the expected readers, and those observers that have announced
  /// themselves. Goes on without them after the longest wait, since a reader that crashed must not
  /// hold up the others, but not when held: the other process is still at work. False when asked to
  /// stop meanwhile.
  [[nodiscard]] bool wait_for_readers(const std::vector<Node::OutputPart>& outputs,
                                      const Succession& succession);
};

/// The outputs of a kind as the deployment names them. `types`: of the kind's ports.
[[nodiscard]] std::vector<Node::OutputPart> make_outputs(Service& service, const KindInfo& kind,
                                                         const PortTypes& types);

}  // namespace quoin::runtime
