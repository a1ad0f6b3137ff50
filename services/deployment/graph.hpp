// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin {

/// What an input port reads.
struct Connection {
  const ServiceConfig* reader = nullptr;
  std::string port = {};  ///< of the reader; "" of an observer
  std::string type = {};  ///< "" when the reader's kind is not known here
  Join join = Join::each;
  const ServiceConfig* writer = nullptr;  ///< the strongest of its instances
  OutputConfig output = {};               ///< of the writer
};

/// Who reads whom in a deployment. Nobody else follows the wiring. Refers to the services it is
/// made of, which must outlive it. Instances of one name count as one writer and as several
/// readers.
class Graph {
 public:
  explicit Graph(const std::vector<ServiceConfig>& services, std::string_view name_space = "");
  explicit Graph(const Deployment& deployment)
      : Graph(deployment.services, deployment.name_space) {}

  /// Of one service, in the order of its ports; an observer has one for each topic that it reads.
  [[nodiscard]] std::vector<Connection> inputs_of(const ServiceConfig& service) const;
  /// Services that read any output of `name`, or the one of that type; observers among them.
  [[nodiscard]] std::vector<const ServiceConfig*> readers_of(std::string_view name,
                                                             std::string_view type = "") const;
  /// How many DDS readers the services of the deployment have on the outputs of `service`. Does not
  /// need to know the kinds of others.
  [[nodiscard]] std::size_t expected_readers(const ServiceConfig& service) const;
  /// The service that the messages of the first `each` port come from, over all stages; the service
  /// itself when it is a source.
  [[nodiscard]] const ServiceConfig& source_of(const ServiceConfig& service) const;
  /// The nearest service from `service` on upstream, itself included, that gives `type`; null when
  /// there is none. Follows the first `each` port.
  [[nodiscard]] const ServiceConfig* upstream(const ServiceConfig& service,
                                              std::string_view type) const;
  /// The outputs that a message of `output` has come by, from the one that numbers it (a source's
  /// scans, or an output at its own rate) to `output` itself. Each with its writer.
  [[nodiscard]] std::vector<Connection> path_to(const ServiceConfig& service,
                                                const OutputConfig& output) const;
  /// The longest way from a source, whose level is 0. Observers come behind all others.
  [[nodiscard]] int level(const ServiceConfig& service) const;
  /// Of the first of its services.
  [[nodiscard]] int level(const ProcessConfig& process) const;
  /// Outputs that no service but observers reads, each with its writer; of instances the strongest.
  [[nodiscard]] std::vector<Connection> ends() const;

  /// Services in an order in which inputs come before those who read them, strong before weak, else
  /// as they were. Those in cycles are left out.
  [[nodiscard]] std::vector<const ServiceConfig*> order() const;
  /// Each cycle once: the services along it, each of which reads the next, the last the first.
  [[nodiscard]] std::vector<std::vector<const ServiceConfig*>> cycles() const;

 private:
  [[nodiscard]] const ServiceConfig* find(std::string_view name) const;
  [[nodiscard]] std::optional<Connection> driving_input(const ServiceConfig& service) const;

  const std::vector<ServiceConfig>& services_;
  std::string name_space_;
  std::map<std::string, const ServiceConfig*, std::less<>> by_name_;  // the strongest
  std::map<std::string, int, std::less<>> levels_;
};

}  // namespace quoin
