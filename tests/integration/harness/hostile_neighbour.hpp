// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Control.h>
#include <idl/Lines.h>
#include <idl/Scan.h>
#include <idl/Segments.h>
#include <idl/Status.h>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin::tests {

/// A neighbour in the domain of a deployment without security that listens to it and then speaks
/// for its services: numbers and stamps that cannot be, sizes and texts without bound, segments
/// that overlap, covariances that are none, bytes of any kind. Nothing of it may be taken for what
/// the services themselves have sent.
class HostileNeighbour {
 public:
  /// `lines`: a line fitting service; what comes before it is attacked, too.
  HostileNeighbour(const TestDeployment& deployment, const std::string& source,
                   const std::string& segmentation, const std::string& lines, std::uint64_t seed);

  /// Takes note of what the services send.
  void listen();
  /// Sends one thing of each kind.
  void attack();
  /// How often, by kind.
  [[nodiscard]] const std::map<std::string, int>& counts() const { return counts_; }
  /// Whether it has heard enough to speak for all services.
  [[nodiscard]] bool informed() const;

 private:
  /// What was heard of a topic last, and a writer of it.
  template <class T>
  struct Topic {
    Topic(runtime::Participant& participant, const TestDeployment& deployment,
          const std::string& service);

    runtime::RawReader reader;
    runtime::RawWriter writer;
    T last;
    bool heard = false;
  };

  template <class T>
  void listen(Topic<T>& topic);
  template <class T, class Change>
  void send(Topic<T>& topic, const char* kind, Change change);
  void attack_scans();
  void attack_segments();
  void attack_lines();
  void attack_heartbeats();
  void attack_control();
  template <class T>
  void send_garbage(Topic<T>& topic);
  [[nodiscard]] std::string nonsense(std::size_t longest);
  [[nodiscard]] std::uint64_t below(std::uint64_t count);

  std::mt19937_64 random_;
  runtime::Participant participant_;
  Topic<msg::Scan> scans_;
  Topic<msg::Segments> segments_;
  Topic<msg::Lines> lines_;
  runtime::Reader<msg::ServiceStatus> heard_statuses_;
  runtime::Writer<msg::ServiceStatus> statuses_;
  runtime::Writer<msg::ControlRequest> requests_;
  std::vector<msg::ServiceStatus> last_statuses_;
  std::map<std::string, int> counts_;
};

}  // namespace quoin::tests
