// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/service_entries.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/parameters/parameter.hpp"
#include "core/sensor/sensor_fields.hpp"
#include "services/deployment/parameter_entries.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin {

namespace {

constexpr int highest_strength = 1'000'000;
const std::vector<std::string> external_qos_names{"best_effort", "sensor", "feature", "state",
                                                  "lossless"};

class ServiceReader {
 public:
  ServiceReader(std::optional<std::string> qos, const KindList& kinds, Problems& problems)
      : qos_of_all_(std::move(qos)), kinds_(kinds), problems_(problems) {}

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
    read_inputs(at);
    // Of services whose kind is not known, too: others read what they publish.
    if (!draft_.config.external()) read_qos();
    if (draft_.config.info != nullptr) read_what_depends_on_the_kind(at);
    // A source asserts its liveliness by its scans alone, which may be 100 ms apart.
    if (draft_.config.inputs.empty()) draft_.config.lease *= 5;
    if (lease_) read_lease(*lease_);
    return std::move(draft_);
  }

 private:
  void read_entry(const Entry& entry) {
    if (entry.key == "name") {
      read_name(entry);
    } else if (entry.key == "kind") {
      kind_ = entry;
    } else if (entry.key == "input" || entry.key == "inputs") {
      if (inputs_) {
        problems_.add(entry.key_at, "'" + entry.key + "' beside '" + inputs_->key +
                                        "' of service '" + draft_.config.name +
                                        "'; write one of them");
        return;
      }
      inputs_ = entry;
    } else if (entry.key == "method") {
      method_ = entry;
    } else if (entry.key == "parameters") {
      parameters_ = entry;
    } else if (entry.key == "sensor") {
      sensor_ = entry;
    } else if (entry.key == "qos") {
      qos_ = entry;
    } else if (entry.key == "topic") {
      topic_ = entry;
    } else if (entry.key == "type") {
      type_ = entry;
    } else if (entry.key == "program") {
      program_ = entry;
    } else if (entry.key == "restart") {
      if (read_choice(entry, "restart policy", {"always", "never"}, problems_) == "never") {
        draft_.config.restart = RestartPolicy::never;
      }
    } else if (entry.key == "host") {
      read_host(entry);
    } else if (entry.key == "strength") {
      strength_ = entry;
      draft_.config.strength = read_integer(entry, "the strength", 0, highest_strength, problems_);
    } else if (entry.key == "lease") {
      lease_ = entry;
    } else {
      problems_.add(entry.key_at,
                    "unknown key '" + entry.key + "' of a service" +
                        suggestion(entry.key, {"name", "kind", "input", "inputs", "method",
                                               "parameters", "sensor", "qos", "restart", "host",
                                               "strength", "lease", "topic", "type", "program"}));
    }
  }

  void read_qos() {
    if (!qos_) {
      draft_.config.qos = qos_of_all_.value_or("");
      return;
    }
    draft_.config.qos =
        read_choice(*qos_, "QoS preset", deployment_qos_names(), problems_).value_or("");
  }

  /// A port that is written as `input: SERVICE`.
  void read_short_input(const Entry& entry) {
    const KindInfo* kind = draft_.config.info;
    if (kind != nullptr && kind->inputs.size() > 1) {
      wrong_inputs(entry.key_at, "kind " + kind->name + " has the ports " + ports_of(*kind) +
                                     "; write inputs: {" + kind->inputs.front().name +
                                     ": SERVICE, ...}");
      return;
    }
    if (!entry.value.IsScalar()) {
      wrong_inputs(entry.value_at,
                   "'input' names one service, not " + what_is(entry.value) +
                       (kind != nullptr && kind->observer ? "; write inputs: [SERVICE, ...]"
                                                          : "; a port reads one"));
      return;
    }
    const bool observer = kind != nullptr && kind->observer;
    const std::string port = kind == nullptr        ? "input"  // whatever its name
                             : kind->inputs.empty() ? ""
                                                    : kind->inputs.front().name;
    add_input(observer ? "" : port, entry.value.Scalar(), entry.value_at);
  }

  /// `inputs: {PORT: SERVICE}`, or `inputs: all` or a list of an observer.
  void read_ports(const Entry& entry) {
    const KindInfo* kind = draft_.config.info;
    if (kind != nullptr && kind->observer ? entry.value.IsMap()
                                          : !entry.value.IsMap() && kind != nullptr) {
      wrong_inputs(entry.value_at, kind->observer
                                       ? "kind " + kind->name +
                                             " reads whatever there is; write inputs: all or "
                                             "inputs: [SERVICE, ...]"
                                       : "'inputs' of kind " + kind->name +
                                             " must be a map of its ports (" + ports_of(*kind) +
                                             "), not " + what_is(entry.value));
      return;
    }
    if (entry.value.IsMap()) {
      for (const Entry& port : entries_of(entry.value, "'inputs'", problems_)) read_port(port);
      return;
    }
    if (entry.value.IsScalar() && entry.value.Scalar() == "all") {
      draft_.config.observes_all = true;
      return;
    }
    for (const Entry& service : read_list(entry, problems_)) {
      add_input("", service.value.Scalar(), service.value_at);
    }
  }

  void read_port(const Entry& entry) {
    const KindInfo* kind = draft_.config.info;
    if (kind != nullptr && kind->input(entry.key) == nullptr) {
      wrong_inputs(entry.key_at, "kind " + kind->name + " has no port '" + entry.key +
                                     "'; it has " + ports_of(*kind));
      return;
    }
    if (const auto text = read_text(entry, problems_)) {
      add_input(entry.key, *text, entry.value_at);
    } else {
      draft_.inputs_are_wrong = true;
    }
  }

  void add_input(const std::string& port, const std::string& service, Position at) {
    draft_.config.inputs.push_back({port, service, at});
  }

  void wrong_inputs(Position at, const std::string& what) {
    problems_.add(at, what);
    draft_.inputs_are_wrong = true;
  }

  static std::string ports_of(const KindInfo& kind) {
    std::string names;
    for (const InputPort& port : kind.inputs) names += (names.empty() ? "" : ", ") + port.name;
    return names;
  }

  void read_inputs(Position at) {
    const KindInfo* kind = draft_.config.info;
    if (kind != nullptr && !kind->reads()) {
      if (!inputs_) return;
      wrong_inputs(inputs_->value_at, "kind " + kind->name +
                                          " is a source and reads no other service; remove the " +
                                          inputs_->key + " of '" + draft_.config.name + "'");
      return;
    }
    if (inputs_) inputs_->key == "input" ? read_short_input(*inputs_) : read_ports(*inputs_);
    if (kind == nullptr || draft_.inputs_are_wrong) return;
    if (kind->observer && !inputs_) {
      wrong_inputs(at, "service '" + draft_.config.name + "' of kind " + kind->name +
                           " needs to know what to read; add inputs: all");
    }
    sort_inputs(*kind);
  }

  /// In the order of the kind's ports.
  void sort_inputs(const KindInfo& kind) {
    const auto place = [&](const InputConfig& input) {
      return kind.input(input.port) - kind.inputs.data();
    };
    if (kind.observer) return;
    std::ranges::stable_sort(draft_.config.inputs, {}, place);
  }

  void read_what_depends_on_the_kind(Position at) {
    if (draft_.config.external()) {
      read_external(at);
      return;
    }
    for (const auto& entry : {topic_, type_, program_}) {
      if (!entry) continue;
      problems_.add(entry->key_at, "'" + entry->key + "' belongs to kind external; kind " +
                                       draft_.config.kind + " names its topics itself");
    }
    const bool known = read_method();
    if (parameters_) {
      draft_.config.parameters = read_parameters(
          *parameters_, draft_.config,
          known ? &parameters_of(*draft_.config.info, draft_.config.method) : nullptr, problems_);
    }
    if (sensor_) read_sensor(*sensor_);
    if (known) require_parameters(parameters_ ? parameters_->key_at : at);
  }

  /// What is known of the sensor of a source: parameters of it, by themselves.
  void read_sensor(const Entry& entry) {
    const KindInfo& kind = *draft_.config.info;
    const std::vector<ParameterInfo> known = sensor_parameters();
    const bool measures = std::ranges::any_of(
        kind.parameters, [&](const ParameterInfo& own) { return own.name == known.front().name; });
    if (!measures) {
      problems_.add(entry.key_at, "'sensor' belongs to a source of scans; kind " + kind.name +
                                      " has no sensor, remove it from '" + draft_.config.name +
                                      "'");
      return;
    }
    for (ParameterSetting& setting : read_parameters(entry, draft_.config, &known, problems_)) {
      const bool twice = std::ranges::any_of(
          draft_.config.parameters,
          [&](const ParameterSetting& other) { return other.name == setting.name; });
      if (twice) {
        problems_.add(position_of(entry.value[setting.name].Mark()),
                      "'" + setting.name + "' of service '" + draft_.config.name +
                          "' stands in 'sensor' and in 'parameters'; remove one");
      }
      draft_.config.parameters.push_back(std::move(setting));
    }
  }

  /// A topic that somebody else writes.
  void read_external(Position at) {
    OutputConfig output;
    if (!topic_) {
      problems_.add(at,
                    "service '" + draft_.config.name +
                        "' of kind external needs the topic that it stands for; add topic: NAME");
    } else if (const auto text = read_text(*topic_, problems_)) {
      if (text->empty() || text->size() > 4 * longest_name ||
          !only_of(*text, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_/~")) {
        problems_.add(topic_->value_at, "the topic '" + *text + "' must be up to " +
                                            std::to_string(4 * longest_name) +
                                            " letters, digits, _, ~ and /");
      }
      output.topic = *text;
    }
    std::vector<std::string> types;
    for (const topics::TopicType& type : topics::topic_types()) types.emplace_back(type.name);
    if (!type_) {
      problems_.add(at, "service '" + draft_.config.name +
                            "' of kind external needs the type of its messages; add type: TYPE");
    } else {
      output.type = read_choice(*type_, "type", types, problems_).value_or("");
    }
    output.qos = "best_effort";
    if (qos_)
      output.qos = read_choice(*qos_, "QoS preset", external_qos_names, problems_).value_or("");
    if (program_) {
      for (const Entry& word : read_list(*program_, problems_)) {
        draft_.config.program.push_back(word.value.Scalar());
      }
    }
    for (const auto& entry : {method_, parameters_, sensor_, strength_}) {
      if (entry) {
        problems_.add(entry->key_at, "kind external has no " + entry->key + "; remove it from '" +
                                         draft_.config.name + "'");
      }
    }
    draft_.config.outputs.push_back(std::move(output));
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
      check_required(parameters_of(*draft_.config.info, draft_.config.method),
                     draft_.config.parameters);
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
    draft_.config.info = kinds_.find(*text);
    if (draft_.config.info == nullptr && kinds_.complete) {
      std::vector<std::string> names;
      for (const KindInfo* kind : kinds_.kinds) names.push_back(kind->name);
      problems_.add(entry.value_at, "unknown kind '" + *text + "' of service '" +
                                        draft_.config.name + "'" + suggestion(*text, names) +
                                        " (quoin methods lists them)");
    }
  }

  /// False when it is not known which parameters there can be.
  bool read_method() {
    const KindInfo& kind = *draft_.config.info;
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

  std::optional<std::string> qos_of_all_;
  const KindList& kinds_;
  Problems& problems_;
  DraftService draft_;
  std::optional<Entry> kind_, inputs_, method_, parameters_, sensor_, qos_, strength_, lease_,
      topic_, type_, program_;
};

}  // namespace

const std::vector<std::string>& deployment_qos_names() {
  static const std::vector<std::string> names{"sensor", "feature", "state", "lossless"};
  return names;
}

std::optional<DraftService> read_service(const YAML::Node& node,
                                         const std::optional<std::string>& qos,
                                         const KindList& kinds, Problems& problems) {
  if (!node.IsMap()) {
    problems.add(position_of(node.Mark()),
                 "a service is a map with the keys name and kind, not " + what_is(node));
    return std::nullopt;
  }
  return ServiceReader(qos, kinds, problems).read(node);
}

}  // namespace quoin
