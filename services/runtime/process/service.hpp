// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/deployment/exit_code.hpp"
#include "services/deployment/graph.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/node/dds_ports.hpp"
#include "services/runtime/node/node.hpp"
#include "services/runtime/node/service_record.hpp"
#include "services/runtime/process/heartbeat.hpp"
#include "services/runtime/process/stop_signal.hpp"

namespace quoin::runtime {

/// What every service process has.
struct Service {
  StopSignal& stop;
  const Deployment& deployment;
  const ServiceConfig& config;
  Graph graph;
  Participant participant;
  ServiceRecord record;
  Heartbeat heartbeat;
  /// Readers of all outputs to wait for before the inputs are opened.
  std::size_t expected_readers;
  std::chrono::duration<double> patience;  ///< with readers that are not there
  bool held;                               ///< to take over from another process of the service

  Service(StopSignal& stop_signal, const Deployment& deployment_file,
          const ServiceConfig& service_config, std::size_t observers,
          std::chrono::duration<double> patience_with_readers, bool to_take_over);

  [[nodiscard]] DataThread data_thread() {
    return {record, heartbeat.pulse(), [this] { return stop.requested(); }};
  }

  /// Waits until the outputs have the expected readers, and those observers that have announced
  /// themselves. Goes on without them when its patience has ended, since a reader that crashed must
  /// not hold up the others, but not when held: the other process is still at work. False when
  /// asked to stop meanwhile.
  [[nodiscard]] bool wait_for_readers(const std::vector<const Output*>& outputs,
                                      const Succession& succession);
};

/// The outputs of a kind as the deployment names them, on DDS. `types`: of the kind's ports.
[[nodiscard]] std::vector<Node::OutputPart> make_outputs(Service& service, const KindInfo& kind,
                                                         const PortTypes& types);

/// The part of main that all services share: command line (--deployment FILE --service NAME), log,
/// deployment file, signals. `check` runs before DDS is touched, for errors in the configuration
/// that only the service can find; `run` does the work and returns the exit code.
int run_service(int argc, char** argv, const KindInfo& kind,
                const std::function<void(const Deployment&, const ServiceConfig&)>& check,
                const std::function<int(Service&)>& run);

}  // namespace quoin::runtime
