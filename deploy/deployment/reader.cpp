// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <fstream>
#include <optional>

#include "core/methods/suggestion.hpp"
#include "deploy/deployment/deployment.hpp"
#include "deploy/deployment/kinds.hpp"
#include "deploy/deployment/network_entries.hpp"
#include "deploy/deployment/parameter_entries.hpp"
#include "deploy/deployment/problems.hpp"
#include "deploy/deployment/wiring.hpp"
#include "deploy/deployment/yaml_entries.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t largest_file = 1U << 20U;  // [byte]
constexpr std::size_t most_services = 256;
constexpr std::size_t longest_name = 64;
constexpr int highest_domain = 232;
constexpr int highest_strength = 1'000'000;

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : problems_(file) { deployment_.file = file; }

  Deployment read(const std::string& text) {
    const std::optional<YAML::Node> root = load_yaml(text, problems_);
    if (root) read_root(*root);
    deployment_.services = wire(drafts_, problems_);
    problems_.raise();
    return std::move(deployment_);
  }

 private:
  void read_root(const YAML::Node& root) {
    const Position at = position_of(root.Mark());
    if (!root.IsMap()) {
      problems_.add(
          at, "a deployment is a map with the keys version and services, not " + what_is(root));
      return;
    }
    deployment_.name_space = "quoin";
    std::optional<Entry> version, services, security;
    // The preset for all must be known before the services are read, wherever it is written.
    for (const Entry& entry : entries_of(root, "the deployment", problems_)) {
      if (entry.key == "version") {
        version = entry;
      } else if (entry.key == "namespace") {
        read_namespace(entry);
      } else if (entry.key == "domain") {
        read_domain(entry);
      } else if (entry.key == "qos") {
        qos_ = read_choice(entry, "QoS preset", qos_names(), problems_);
      } else if (entry.key == "network") {
        deployment_.network = read_network(entry, problems_);
      } else if (entry.key == "security") {
        security = entry;
        deployment_.security = read_security(entry, deployment_.file.parent_path(), problems_);
      } else if (entry.key == "services") {
        services = entry;
      } else {
        problems_.add(entry.key_at,
                      "unknown key '" + entry.key + "' of the deployment" +
                          suggestion(entry.key, {"version", "namespace", "domain", "qos", "network",
                                                 "security", "services"}));
      }
    }
    if (security && deployment_.network.discovery != Discovery::peers) {
      // With servers Fast DDS 2.9 ends the process (it has secure ones from 2.10 on); with multicast
      // some of ten participants that start at once never finish their handshake.
      problems_.add(security->key_at,
                    "security can be had with discovery: peers only; list the addresses of the "
                    "hosts in the network's peers");
    }
    if (!version) {
      problems_.add(at, "missing key 'version'; write version: 1");
    } else if (!version->value.IsScalar() || version->value.Scalar() != "1") {
      problems_.add(version->value_at, "version must be 1, not " + what_is(version->value));
    }
    if (!services) {
      problems_.add(at, "missing key 'services'; it lists the services, each with name and kind");
    } else {
      read_services(*services);
    }
  }

  void read_namespace(const Entry& entry) {
    const auto text = read_text(entry, problems_);
    if (!text) return;
    constexpr auto allowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_/";
    if (text->empty() || !only_of(*text, allowed) || text->front() == '/' || text->back() == '/' ||
        text->find("//") != std::string::npos || text->size() > longest_name) {
      problems_.add(entry.value_at, "the namespace '" + *text + "' must be up to " +
                                        std::to_string(longest_name) +
                                        " letters, digits and _, with single / between parts");
      return;
    }
    deployment_.name_space = *text;
  }

  void read_domain(const Entry& entry) {
    if (const auto domain = read_integer(entry, "the domain", 0, highest_domain, problems_)) {
      deployment_.domain = *domain;
    }
  }

  void read_services(const Entry& entry) {
    if (!entry.value.IsSequence()) {
      problems_.add(entry.value_at, "'services' must be a list, each with name and kind, not " +
                                        what_is(entry.value));
      return;
    }
    if (entry.value.size() == 0) {
      problems_.add(entry.value_at, "'services' is empty; add at least one with name and kind");
    }
    if (entry.value.size() > most_services) {
      problems_.add(entry.value_at, std::to_string(entry.value.size()) + " services; at most " +
                                        std::to_string(most_services) + " can be deployed");
      return;
    }
    for (const YAML::Node& node : entry.value) read_service(node);
  }

  void read_service(const YAML::Node& node) {
    const Position at = position_of(node.Mark());
    if (!node.IsMap()) {
      problems_.add(at, "a service is a map with the keys name and kind, not " + what_is(node));
      return;
    }
    DraftService draft;
    draft.config.position = at;
    std::optional<Entry> kind, method, parameters, lease;
    bool named = false;
    std::optional<std::string> qos = qos_;
    for (const Entry& entry : entries_of(node, "a service", problems_)) {
      if (entry.key == "name") {
        named = true;
        read_name(entry, draft);
      } else if (entry.key == "kind") {
        kind = entry;
      } else if (entry.key == "input") {
        if (const auto text = read_text(entry, problems_)) {
          draft.config.input = *text;
          draft.input_at = entry.value_at;
        }
      } else if (entry.key == "method") {
        method = entry;
      } else if (entry.key == "parameters") {
        parameters = entry;
      } else if (entry.key == "qos") {
        qos = read_choice(entry, "QoS preset", qos_names(), problems_);
      } else if (entry.key == "restart") {
        if (read_choice(entry, "restart policy", {"always", "never"}, problems_) == "never") {
          draft.config.restart = RestartPolicy::never;
        }
      } else if (entry.key == "host") {
        read_host(entry, draft);
      } else if (entry.key == "strength") {
        draft.config.strength = read_integer(entry, "the strength", 0, highest_strength, problems_);
      } else if (entry.key == "lease") {
        lease = entry;
      } else {
        problems_.add(entry.key_at,
                      "unknown key '" + entry.key + "' of a service" +
                          suggestion(entry.key, {"name", "kind", "input", "method", "parameters",
                                                 "qos", "restart", "host", "strength", "lease"}));
      }
    }
    if (!named) problems_.add(at, "a service without a name; add name: NAME");
    if (!kind) {
      problems_.add(at, "service '" + draft.config.name +
                            "' has no kind; add kind: KIND (quoin methods lists them)");
    } else {
      read_kind(*kind, draft);
    }
    if (draft.kind != nullptr) {
      draft.config.qos = qos.value_or(draft.kind->qos);
      // A source tells that it lives by its scans alone, which may be 100 ms apart.
      if (draft.kind->input == MessageType::none) draft.config.lease *= 5;
      const bool known = read_method(method, draft);
      if (parameters) {
        draft.config.parameters = read_parameters(
            *parameters, draft.config,
            known ? &parameters_of(*draft.kind, draft.config.method) : nullptr, problems_);
      }
      if (known) require_parameters(parameters ? parameters->key_at : at, draft);
    }
    if (lease) read_lease(*lease, draft);
    drafts_.push_back(std::move(draft));
  }

  void read_lease(const Entry& entry, DraftService& draft) {
    if (!draft.config.strength) {
      problems_.add(entry.key_at, "a lease without a strength; add strength: NUMBER");
      return;
    }
    if (const auto seconds = read_seconds(entry, "the lease", 0.02, 60.0, problems_)) {
      draft.config.lease =
          std::chrono::round<std::chrono::milliseconds>(std::chrono::duration<double>(*seconds));
    }
  }

  void read_host(const Entry& entry, DraftService& draft) {
    const auto text = read_text(entry, problems_);
    if (!text) return;
    if (text->empty() || text->size() > longest_name ||
        !only_of(*text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._")) {
      problems_.add(entry.value_at, "the host '" + *text + "' must be up to " +
                                        std::to_string(longest_name) +
                                        " letters, digits, -, . and _");
    }
    draft.config.host = *text;  // a bad one, too: it has been named
  }

  void require_parameters(Position at, const DraftService& draft) {
    try {
      check_required(parameters_of(*draft.kind, draft.config.method), draft.config.parameters);
    } catch (const ParameterError& error) {
      problems_.add(at, "parameter '" + error.parameter() + "' of service '" + draft.config.name +
                            "' " + error.what());
    }
  }

  void read_name(const Entry& entry, DraftService& draft) {
    draft.name_at = entry.value_at;
    const auto text = read_text(entry, problems_);
    if (!text) return;
    // A bad name is kept, so that inputs that name it give no second error.
    draft.config.name = *text;
    if (text->empty() || text->size() > longest_name ||
        !only_of(*text, "abcdefghijklmnopqrstuvwxyz0123456789_")) {
      problems_.add(entry.value_at, "the name '" + *text + "' must be 1 to " +
                                        std::to_string(longest_name) +
                                        " of the characters a-z, 0-9 and _");
    }
  }

  void read_kind(const Entry& entry, DraftService& draft) {
    const auto text = read_text(entry, problems_);
    if (!text) return;
    draft.config.kind = *text;
    draft.kind = find_kind(*text);
    if (draft.kind == nullptr) {
      std::vector<std::string> names;
      for (const KindInfo& kind : kinds()) names.push_back(kind.name);
      problems_.add(entry.value_at, "unknown kind '" + *text + "' of service '" +
                                        draft.config.name + "'" + suggestion(*text, names) +
                                        " (quoin methods lists them)");
    }
  }

  /// False when it is not known which parameters there can be.
  bool read_method(const std::optional<Entry>& entry, DraftService& draft) {
    const KindInfo& kind = *draft.kind;
    if (!entry) {
      if (!kind.methods.empty()) draft.config.method = kind.methods.front().name;
      return true;
    }
    const auto text = read_text(*entry, problems_);
    if (!text) return false;
    if (kind.methods.empty()) {
      problems_.add(entry->key_at, "kind " + kind.name + " has no methods; remove the method of '" +
                                       draft.config.name + "'");
      return true;
    }
    std::vector<std::string> names;
    for (const MethodInfo& info : kind.methods) {
      if (info.name == *text) {
        draft.config.method = *text;
        return true;
      }
      names.push_back(info.name);
    }
    problems_.add(entry->value_at, "unknown method '" + *text + "' for service '" +
                                       draft.config.name + "'" + suggestion(*text, names) +
                                       " (quoin methods lists them)");
    return false;
  }

  static const std::vector<std::string>& qos_names() {
    static const std::vector<std::string> names{"sensor", "feature", "state", "lossless"};
    return names;
  }

  Problems problems_;
  Deployment deployment_;
  std::optional<std::string> qos_;
  std::vector<DraftService> drafts_;
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw DeploymentError({file.string() + ": " + what});
}

}  // namespace

Deployment parse_deployment(const std::string& text, const std::filesystem::path& file) {
  if (text.size() > largest_file)
    fail(file, "larger than 1 MiB; a deployment file is a few kilobytes");
  return Reader(file).read(text);
}

Deployment load_deployment(const std::filesystem::path& file) {
  return parse_deployment(read_deployment(file), file);
}

std::string read_deployment(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    fail(file, "no such file; deploy/examples has some to start from");
  }
  if (error) fail(file, "cannot be read: " + error.message());
  if (std::filesystem::is_directory(status)) fail(file, "is a directory; name the file in it");
  if (!std::filesystem::is_regular_file(status)) fail(file, "is not a regular file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, "cannot be opened; check its permissions");
  // One byte more than allowed tells too large from just fitting, whatever the size of the file.
  std::string text(largest_file + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) fail(file, "cannot be read");
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

}  // namespace quoin::deploy
