// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters/parameter.hpp"
#include "services/deployment/kind.hpp"

namespace quoin {

/// Place in a file, both from 1.
struct Position {
  int line = 0;
  int column = 0;
};

/// What to do when a service's process dies.
enum class RestartPolicy {
  always,  ///< start it again, with back-off
  never,   ///< leave it dead
};

/// How participants find each other.
enum class Discovery {
  multicast,  ///< announcements to all on the network
  server,     ///< through discovery servers, each of which suffices
  peers,      ///< announcements to each of the listed hosts
};

struct ServerAddress {
  std::string address;  ///< IPv4
  std::uint16_t port = 0;

  friend bool operator==(const ServerAddress&, const ServerAddress&) = default;
};

/// How long a participant is kept that is not heard of any more [s]: on the loopback interface, and
/// on a network, where a link may fail for a while.
inline constexpr double loopback_lease = 5.0;
inline constexpr double network_lease = 20.0;

/// The interfaces that DDS uses, and how discovery works on them.
struct NetworkConfig {
  /// Names (eth0), IPv4 addresses or networks (10.7.0.0/24); each host uses those of them that it
  /// has. Empty: 127.0.0.1 alone.
  std::vector<std::string> interfaces;
  Discovery discovery = Discovery::peers;
  std::vector<std::string> peers;      ///< IPv4 addresses of the hosts, with Discovery::peers
  std::vector<ServerAddress> servers;  ///< with Discovery::server
  /// [s] Shorter cuts of a link lose nothing with the lossless preset; a process that was killed is
  /// forgotten after this time.
  double lease = loopback_lease;

  friend bool operator==(const NetworkConfig&, const NetworkConfig&) = default;
};

/// A network that no file describes, as texts; "" and empty lists say nothing.
struct NetworkText {
  std::vector<std::string> interfaces;
  std::string discovery;
  std::vector<std::string> peers;
  std::vector<std::string> servers;  ///< ADDRESS or ADDRESS:PORT
};

/// DDS Security: every participant proves its identity and has permissions of its own.
struct SecurityConfig {
  std::filesystem::path directory;  ///< of the keys
  bool encrypt = true;              ///< messages are encrypted, not only signed

  friend bool operator==(const SecurityConfig&, const SecurityConfig&) = default;
};

/// A distribution of ROS 2, as far as its graph of nodes is another one on the wire.
enum class RosDistro { humble, iron, jazzy, rolling };

/// An input port as the file wires it.
struct InputConfig {
  std::string port;     ///< of the kind; "" of an observer
  std::string service;  ///< name of the one whose output is read
  Position position;

  friend bool operator==(const InputConfig& a, const InputConfig& b) {
    return a.port == b.port && a.service == b.service;
  }
};

/// A topic that a service writes.
struct OutputConfig {
  std::string type;   ///< of the table of topic types
  std::string topic;  ///< <namespace>/<service>/<type>, or an external service's own
  std::string qos;    ///< preset: sensor, feature, state, lossless or best_effort
  Rate rate = Rate::per_input;

  friend bool operator==(const OutputConfig&, const OutputConfig&) = default;
};

struct ServiceConfig {
  std::string name;
  std::string kind;
  /// Null when this program does not know the kind, which only happens in a service.
  const KindInfo* info = nullptr;
  std::vector<InputConfig> inputs;    ///< in the order of the kind's ports; none of sources
  std::vector<OutputConfig> outputs;  ///< in the order of the kind's; none when it is not known
  bool observes_all = false;          ///< `inputs: all`, which stands in `inputs`, too
  std::string
      method;       ///< the kind's default when the file names none; "" for kinds without methods
  std::string qos;  ///< preset that the file asks for; "" when each type has its default
  ParameterSettings parameters;  ///< validated against the method or kind
  RestartPolicy restart = RestartPolicy::always;
  std::string host;     ///< where it runs; "" when the deployment names no hosts
  std::string process;  ///< of `processes:` that it runs in; "" when it has one of its own
  /// Of this instance's claim to the output, when there are several of one name; the strongest that
  /// lives is heard.
  std::optional<int> strength;
  /// With a strength: how long this instance may be silent before the next one is heard.
  std::chrono::milliseconds lease{100};
  /// Of kind external: command line of a program to run with the deployment; else empty.
  std::vector<std::string> program;
  Position position;  ///< of the service in the file

  [[nodiscard]] bool external() const { return info == &external_kind(); }
  /// Whether a process runs for it.
  [[nodiscard]] bool has_process() const { return !external() || !program.empty(); }
  /// Whether what it publishes comes from no other service.
  [[nodiscard]] bool is_source() const { return inputs.empty() && !outputs.empty(); }
  /// Null when it gives no such type.
  [[nodiscard]] const OutputConfig* output(std::string_view type) const;
  /// The service behind a port; "" when it is not wired.
  [[nodiscard]] std::string_view input(std::string_view port) const;
};

/// A deployment file, validated: every name exists, every input fits, there is no cycle.
struct Deployment {
  std::filesystem::path file;
  std::string name_space;  ///< prefix of all topics
  int domain = 0;          ///< DDS domain, 0..232
  NetworkConfig network;
  std::optional<SecurityConfig> security;
  /// Whose graph of nodes shows the services; nothing: none, and nothing is announced.
  std::optional<RosDistro> ros;
  std::vector<ServiceConfig> services;  ///< inputs before those who read them, strong before weak

  /// By label, or by name: then the strongest of its instances. Throws std::out_of_range when there
  /// is no such service.
  [[nodiscard]] const ServiceConfig& service(std::string_view name) const;
};

/// What distinguishes an instance of a service from all others: the name, or name@strength where
/// there is a strength.
[[nodiscard]] std::string label(const ServiceConfig& service);

/// What distinguishes the process of a service from all others: its name in `processes:`, or the
/// label of the service where it has one of its own.
[[nodiscard]] std::string process_name(const ServiceConfig& service);

/// A process, and the services that run in it in the order of the deployment.
struct ProcessConfig {
  std::string name;
  std::vector<const ServiceConfig*> services;
};
/// All that run, on whatever host, in the order of their first services. Refers to the deployment.
[[nodiscard]] std::vector<ProcessConfig> processes_of(const Deployment& deployment);

/// Whether `reader` gets the messages of `writer` inside the process that both run in. Those of a
/// service with several instances go by DDS, which decides between them.
[[nodiscard]] bool share_memory(const ServiceConfig& writer, const ServiceConfig& reader);

/// One or more things wrong with a deployment file, each as "file:line:column: what; what to do",
/// joined by line feeds in what().
class DeploymentError : public std::runtime_error {
 public:
  explicit DeploymentError(std::vector<std::string> messages);
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

/// Reads and validates a deployment file of services of `kinds`. Throws DeploymentError with all
/// that is wrong.
[[nodiscard]] Deployment load_deployment(const std::filesystem::path& file, const KindList& kinds);

/// The text of a deployment file, not more of it than parse_deployment takes. Throws
/// DeploymentError.
[[nodiscard]] std::string read_deployment(const std::filesystem::path& file);

/// The same as load_deployment for text already in memory; `file` is what messages name.
[[nodiscard]] Deployment parse_deployment(const std::string& text,
                                          const std::filesystem::path& file, const KindList& kinds);

/// What `network:` with these entries would give. Throws DeploymentError, whose messages name no
/// place.
[[nodiscard]] NetworkConfig parse_network(const NetworkText& text);

/// From the death of a discovery server to the next one at its address: when all have forgotten the
/// dead one. A new server too soon would be taken for it, and not learn of those that it should
/// know.
[[nodiscard]] std::chrono::milliseconds discovery_pause(const NetworkConfig& network);

/// The hosts that services name, each once, in the order of the services; none when all run on one.
[[nodiscard]] std::vector<std::string> hosts_of(const Deployment& deployment);

/// Topic of an output of the service `name`.
[[nodiscard]] std::string output_topic(std::string_view name_space, std::string_view name,
                                       std::string_view type);
/// The preset of a topic of that type when the file asks for `wanted`, "" for the default. What
/// late joiners need the newest of (state) stays so, whatever is asked for.
[[nodiscard]] std::string effective_qos(std::string_view wanted, std::string_view type);

/// Topics shared by all services.
[[nodiscard]] std::string status_topic(std::string_view name_space);
[[nodiscard]] std::string control_request_topic(std::string_view name_space);
[[nodiscard]] std::string control_reply_topic(std::string_view name_space);

/// What control requests to the supervisor of a host's share are addressed to; no service is called
/// so.
[[nodiscard]] std::string supervisor_name(std::string_view host);

/// Exit codes of all programs: what the supervisor concludes from them, the services must mean.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_configuration = 2,  ///< wrong usage or configuration: starting again does not help
  exit_input = 3,          ///< the input of a source is unusable
};

}  // namespace quoin
