// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/service_entries.hpp"

#include <chrono>
#include <utility>

#include "core/parameters/suggestion.hpp"
#include "services/deployment/kinds.hpp"
#include "services/deployment/parameter_entries.hpp"

namespace quoin {

namespace {

constexpr int highest_strength = 1'000'000;

class ServiceReader {
 public:
  ServiceReader(std::optional<std::string> qos, Problems& problems)
      : qos_(std::move(qos)), problems_(problems) {}

  DraftService read(const YAML::Node& map) {
    const Position at = position_of(map.Mark());
    draft_.config.position = at;
    // What depends on other entries waits until all have been seen, in whatever order.
    for (const Entry& entry : entries_of(map, "a service", problems_)) read_entry(entry);
    if (draft_.name_at.line == 0) problems_.add(at, "a service without a name; add name: NAME");
    if (!kind_) {
      problems_.add(at, "service '" + draft_.config.name +
                            "' has no kind; add kind: KIND (quoin methods lists them)");
    } else {
      read_kind(*kind_);
    }
    if (draft_.kind != nullptr) read_what_depends_on_the_kind(at);
    if (lease_) read_lease(*lease_);
    return std::move(draft_);
  }

 private:
  void read_entry(const Entry& entry) {
    if (entry.key == "name") {
      read_name(entry);
    } else if (entry.key == "kind") {
      kind_ = entry;
    } else if (entry.key == "input") {
      if (const auto text = read_text(entry, problems_)) {
        draft_.config.input = *text;
        draft_.input_at = entry.value_at;
      }
    } else if (entry.key == "method") {
      method_ = entry;
    } else if (entry.key == "parameters") {
      parameters_ = entry;
    } else if (entry.key == "qos") {
      qos_ = read_choice(entry, "QoS preset", qos_names(), problems_);
    } else if (entry.key == "restart") {
      if (read_choice(entry, "restart policy", {"always", "never"}, problems_) == "never") {
        draft_.config.restart = RestartPolicy::never;
      }
    } else if (entry.key == "host") {
      read_host(entry);
    } else if (entry.key == "strength") {
      draft_.config.strength = read_integer(entry, "the strength", 0, highest_strength, problems_);
    } else if (entry.key == "lease") {
      lease_ = entry;
    } else {
      problems_.add(entry.key_at,
                    "unknown key '" + entry.key + "' of a service" +
                        suggestion(entry.key, {"name", "kind", "input", "method", "parameters",
                                               "qos", "restart", "host", "strength", "lease"}));
    }
  }

  void read_what_depends_on_the_kind(Position at) {
    draft_.config.qos = qos_.value_or(draft_.kind->qos);
    // A source tells that it lives by its scans alone, which may be 100 ms apart.
    if (draft_.kind->input == MessageType::none) draft_.config.lease *= 5;
    const bool known = read_method();
    if (parameters_) {
      draft_.config.parameters = read_parameters(
          *parameters_, draft_.config,
          known ? &parameters_of(*draft_.kind, draft_.config.method) : nullptr, problems_);
    }
    if (known) require_parameters(parameters_ ? parameters_->key_at : at);
  }

  void read_lease(const Entry& entry) {
    if (!draft_.config.strength) {
      problems_.add(entry.key_at, "a lease without a strength; add strength: NUMBER");
      return;
    }
    if (const auto seconds = read_seconds(entry, "the lease", 0.02, 60.0, problems_)) {
      draft_.config.lease =
          std::chrono::round<std::chrono::milliseconds>(std::chrono::duration<double>(*seconds));
    }
  }

  void read_host(const Entry& entry) {
    const auto text = read_text(entry, problems_);
    if (!text) return;
    if (text->empty() || text->size() > longest_name ||
        !only_of(*text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._")) {
      problems_.add(entry.value_at, "the host '" + *text + "' must be up to " +
                                        std::to_string(longest_name) +
                                        " letters, digits, -, . and _");
    }
    draft_.config.host = *text;  // a bad one, too: it has been named
  }

  void require_parameters(Position at) {
    try {
      check_required(parameters_of(*draft_.kind, draft_.config.method), draft_.config.parameters);
    } catch (const ParameterError& error) {
      problems_.add(at, "parameter '" + error.parameter() + "' of service '" + draft_.config.name +
                            "' " + error.what());
    }
  }

  void read_name(const Entry& entry) {
    draft_.name_at = entry.value_at;
    const auto text = read_text(entry, problems_);
    if (!text) return;
    // A bad name is kept, so that inputs that name it give no second error.
    draft_.config.name = *text;
    if (text->empty() || text->size() > longest_name ||
        !only_of(*text, "abcdefghijklmnopqrstuvwxyz0123456789_")) {
      problems_.add(entry.value_at, "the name '" + *text + "' must be 1 to " +
                                        std::to_string(longest_name) +
                                        " of the characters a-z, 0-9 and _");
    }
  }

  void read_kind(const Entry& entry) {
    const auto text = read_text(entry, problems_);
    if (!text) return;
    draft_.config.kind = *text;
    draft_.kind = find_kind(*text);
    if (draft_.kind == nullptr) {
      std::vector<std::string> names;
      for (const KindInfo& kind : kinds()) names.push_back(kind.name);
      problems_.add(entry.value_at, "unknown kind '" + *text + "' of service '" +
                                        draft_.config.name + "'" + suggestion(*text, names) +
                                        " (quoin methods lists them)");
    }
  }

  /// False when it is not known which parameters there can be.
  bool read_method() {
    const KindInfo& kind = *draft_.kind;
    if (!method_) {
      if (!kind.methods.empty()) draft_.config.method = kind.methods.front().name;
      return true;
    }
    const auto text = read_text(*method_, problems_);
    if (!text) return false;
    if (kind.methods.empty()) {
      problems_.add(method_->key_at, "kind " + kind.name +
                                         " has no methods; remove the method of '" +
                                         draft_.config.name + "'");
      return true;
    }
    std::vector<std::string> names;
    for (const MethodInfo& info : kind.methods) {
      if (info.name == *text) {
        draft_.config.method = *text;
        return true;
      }
      names.push_back(info.name);
    }
    problems_.add(method_->value_at, "unknown method '" + *text + "' for service '" +
                                         draft_.config.name + "'" + suggestion(*text, names) +
                                         " (quoin methods lists them)");
    return false;
  }

  std::optional<std::string> qos_;
  Problems& problems_;
  DraftService draft_;
  std::optional<Entry> kind_, method_, parameters_, lease_;
};

}  // namespace

const std::vector<std::string>& qos_names() {
  static const std::vector<std::string> names{"sensor", "feature", "state", "lossless"};
  return names;
}

std::optional<DraftService> read_service(const YAML::Node& node,
                                         const std::optional<std::string>& qos,
                                         Problems& problems) {
  if (!node.IsMap()) {
    problems.add(position_of(node.Mark()),
                 "a service is a map with the keys name and kind, not " + what_is(node));
    return std::nullopt;
  }
  return ServiceReader(qos, problems).read(node);
}

}  // namespace quoin
