// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <optional>
#include <string_view>
#include <system_error>

#include "core/parameters/parameter.hpp"
#include "core/text/printable.hpp"
#include "services/deployment/deployment.hpp"
#include "services/deployment/network_entries.hpp"
#include "services/deployment/problems.hpp"
#include "services/deployment/process_entries.hpp"
#include "services/deployment/service_entries.hpp"
#include "services/deployment/wiring.hpp"
#include "services/deployment/yaml_entries.hpp"
#include "services/files/regular_file.hpp"

namespace quoin {

namespace {

constexpr std::size_t largest_file = 256U << 10U;  // [byte] for a thousand bytes a service
constexpr std::size_t most_services = 256;
constexpr int highest_domain = 232;

/// Where a text is not UTF-8, or has characters that a terminal does not show.
std::optional<Position> first_unprintable(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  Position at{1, 1};
  while (!text.empty()) {
    const Utf8Character character = first_character(text);
    const bool layout =
        character.code == U'\n' || character.code == U'\r' || character.code == U'\t';
    if (character.size == 0 || !(layout || is_printable(character.code))) return at;
    at = character.code == U'\n' ? Position{at.line + 1, 1} : Position{at.line, at.column + 1};
    text.remove_prefix(character.size);
  }
  return std::nullopt;
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, const KindList& kinds)
      : kinds_(kinds), problems_(file) {
    deployment_.file = file;
  }

  Deployment read(const std::string& text) {
    if (const auto at = first_unprintable(text)) {
      problems_.add(*at,
                    "a byte that is no text; write the file in UTF-8, without control characters");
      problems_.raise();
    }
    const std::optional<YAML::Node> root = load_yaml(text, problems_);
    if (root) read_root(*root);
    deployment_.services = wire(drafts_, deployment_.name_space, kinds_, problems_);
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
    std::optional<Entry> version, services, processes, security, ros;
    // The preset for all must be known before the services are read, wherever it is written.
    for (const Entry& entry : entries_of(root, "the deployment", problems_)) {
      if (entry.key == "version") {
        version = entry;
      } else if (entry.key == "namespace") {
        read_namespace(entry);
      } else if (entry.key == "domain") {
        read_domain(entry);
      } else if (entry.key == "qos") {
        qos_ = read_choice(entry, "QoS preset", deployment_qos_names(), problems_);
      } else if (entry.key == "network") {
        deployment_.network = read_network(entry, problems_);
      } else if (entry.key == "security") {
        security = entry;
        deployment_.security = read_security(entry, deployment_.file.parent_path(), problems_);
      } else if (entry.key == "ros") {
        ros = entry;
        deployment_.ros = read_ros(entry, problems_);
      } else if (entry.key == "services") {
        services = entry;
      } else if (entry.key == "processes") {
        processes = entry;
      } else {
        problems_.add(entry.key_at,
                      "unknown key '" + entry.key + "' of the deployment" +
                          suggestion(entry.key, {"version", "namespace", "domain", "qos", "network",
                                                 "security", "ros", "services", "processes"}));
      }
    }
    if (security && deployment_.network.discovery != Discovery::peers) {
      // With servers Fast DDS 2.9 ends the process (it has secure ones from 2.10 on); with
      // multicast some of ten participants that start at once never finish their handshake.
      problems_.add(security->key_at,
                    "security can be had with discovery: peers only; list the addresses of the "
                    "hosts in the network's peers");
    }
    if (security && ros) {
      problems_.add(ros->key_at,
                    "ROS 2 has no keys of this deployment's security, so that it sees no node; "
                    "remove ros or security");
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
    if (processes) read_processes(*processes, drafts_, problems_);
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
    for (const YAML::Node& node : entry.value) {
      if (auto draft = read_service(node, qos_, kinds_, problems_))
        drafts_.push_back(std::move(*draft));
    }
  }

  const KindList& kinds_;
  Problems problems_;
  Deployment deployment_;
  std::optional<std::string> qos_;
  std::vector<DraftService> drafts_;
};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw DeploymentError({file.string() + ": " + what});
}

}  // namespace

Deployment parse_deployment(const std::string& text, const std::filesystem::path& file,
                            const KindList& kinds) {
  if (text.size() > largest_file)
    fail(file, "larger than 256 KiB; a deployment file is a few kilobytes");
  return Reader(file, kinds).read(text);
}

Deployment load_deployment(const std::filesystem::path& file, const KindList& kinds) {
  return parse_deployment(read_deployment(file), file, kinds);
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
  // Of a file that is too large the parser says so; of what is longer nothing is wanted.
  std::string text;
  const std::string problem = read_regular(file, largest_file, text);
  if (!problem.empty() && text.size() <= largest_file) fail(file, "cannot be read: " + problem);
  return text;
}

}  // namespace quoin
