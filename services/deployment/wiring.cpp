// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/wiring.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "core/parameters/parameter.hpp"
#include "services/deployment/graph.hpp"

namespace quoin {

namespace {

using Index = std::map<std::string, std::size_t>;

/// Whether two services of one name are instances that stand in for each other.
bool are_instances(const DraftService& one, const DraftService& other) {
  return one.config.strength && other.config.strength &&
         one.config.strength != other.config.strength && one.config.kind == other.config.kind &&
         one.config.qos == other.config.qos && one.config.lease == other.config.lease;
}

Index index_names(const std::vector<DraftService>& drafts, Problems& problems) {
  Index index;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const std::string& name = drafts[i].config.name;
    if (name.empty()) continue;
    index.emplace(name, i);
    const auto other =
        std::find_if(drafts.begin(), drafts.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const DraftService& draft) {
                       return draft.config.name == name && !are_instances(draft, drafts[i]);
                     });
    if (other == drafts.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    const Position at = other->name_at;
    problems.add(
        drafts[i].name_at,
        "the name '" + name + "' is taken by the service at " + std::to_string(at.line) + ":" +
            std::to_string(at.column) +
            "; names must be unique, unless the services are of one kind, QoS and lease and have "
            "different strengths");
  }
  return index;
}

/// Whether a parameter of the kind lists the types that it gives.
bool is_listed(const KindInfo& kind, const OutputPort& port) {
  const auto info = std::ranges::find(kind.parameters, port.parameter, &ParameterInfo::name);
  return info != kind.parameters.end() && info->type == ParameterType::text;
}

/// Names of the kinds that give `type`, or would by a switch.
std::string writers_of(std::string_view type, const KindList& kinds) {
  std::string names;
  for (const KindInfo* kind : kinds.kinds) {
    const OutputPort* port = kind->output(type);
    if (port == nullptr || (is_listed(*kind, *port) && !kind->gives(*port, {}))) continue;
    names += (names.empty() ? "" : " or ") + kind->name;
  }
  return names.empty() ? "that gives " + std::string(type) : "of kind " + names;
}

/// Kinds to put one after the other between something that gives `from` and something that reads
/// `to`; nothing when no chain of kinds with one input does it.
std::optional<std::vector<std::string>> kinds_between(std::string from, const std::string& to,
                                                      const KindList& kinds) {
  std::vector<std::string> chain;
  while (from != to) {
    const auto next =
        std::find_if(kinds.kinds.begin(), kinds.kinds.end(), [&](const KindInfo* kind) {
          return kind->inputs.size() == 1 && kind->inputs.front().type == from &&
                 !kind->outputs.empty();
        });
    if (next == kinds.kinds.end() || chain.size() > kinds.kinds.size()) return std::nullopt;
    chain.push_back((*next)->name);
    from = (*next)->outputs.front().type;
  }
  return chain;
}

std::string types_of(const ServiceConfig& service) {
  std::string types;
  for (const OutputConfig& output : service.outputs) {
    types += (types.empty() ? "" : " and ") + output.type;
  }
  return types;
}

std::string mismatch(const ServiceConfig& writer, const ServiceConfig& reader,
                     const std::string& wanted, const KindList& kinds) {
  if (writer.outputs.empty() && writer.info != nullptr && !writer.info->outputs.empty()) {
    std::string types;
    for (const OutputPort& port : writer.info->outputs) {
      types += (types.empty() ? "" : ", ") + port.type;
    }
    return "'" + writer.name + "' publishes nothing, since '" +
           writer.info->outputs.front().parameter + "' in its parameters names none of " + types;
  }
  if (writer.outputs.empty()) {
    return "'" + writer.name + "' of kind " + writer.kind + " publishes nothing; name a service " +
           writers_of(wanted, kinds);
  }
  const OutputPort* const port = writer.info == nullptr ? nullptr : writer.info->output(wanted);
  std::string alternative;
  if (port != nullptr && !port->parameter.empty()) {
    if (!is_listed(*writer.info, *port)) {
      return "'" + writer.name + "' gives " + wanted + " only if asked to; set " + port->parameter +
             ": true in its parameters";
    }
    alternative =
        ", or set " + port->parameter + ": " + wanted + " in its parameters where it has them";
  }
  std::string text = "'" + writer.name + "' gives " + types_of(writer) + " but " + reader.kind +
                     " reads " + wanted;
  const auto chain = kinds_between(writer.outputs.front().type, wanted, kinds);
  if (!chain) return text + "; name a service " + writers_of(wanted, kinds) + alternative;
  std::string kinds_text;
  for (const std::string& kind : *chain) {
    kinds_text += (kinds_text.empty() ? "a " : " and a ") + kind;
  }
  return text + "; put " + kinds_text + " between" + alternative;
}

/// Where `reader` names `writer` as an input.
Position place_of(const ServiceConfig& reader, const ServiceConfig& writer) {
  for (const InputConfig& input : reader.inputs) {
    if (input.service == writer.name) return input.position;
  }
  return reader.position;
}

/// Adds a problem for each cycle; returns the names of the services in them.
std::set<std::string> check_cycles(const Graph& graph, Problems& problems) {
  std::set<std::string> in_cycle;
  for (const auto& cycle : graph.cycles()) {
    for (const ServiceConfig* service : cycle) in_cycle.insert(service->name);
    const ServiceConfig& first = *cycle.front();
    if (cycle.size() == 1) {
      problems.add(place_of(first, first),
                   "'" + first.name + "' reads itself; name another service as its input");
      continue;
    }
    std::string text = "cycle: '" + first.name + "'";
    for (std::size_t i = 1; i < cycle.size(); ++i) text += " reads '" + cycle[i]->name + "'";
    problems.add(place_of(first, *cycle[1]),
                 text + " reads '" + first.name + "'; start from a source of scans");
  }
  return in_cycle;
}

/// Each required port is wired, each wired one to a service that gives what it reads.
void check_inputs(const ServiceConfig& service, const Index& index,
                  const std::vector<ServiceConfig>& services, const KindList& kinds,
                  Problems& problems) {
  if (service.info != nullptr) {
    for (const InputPort& port : service.info->inputs) {
      if (!port.required || !service.input(port.name).empty()) continue;
      const bool only = service.info->inputs.size() == 1;
      problems.add(service.position,
                   "service '" + service.name + "' of kind " + service.kind + " needs an input" +
                       (only ? "" : " '" + port.name + "'") + " that gives " + port.type +
                       (only ? "; add input: NAME of a service "
                             : "; add " + port.name + ": NAME to its inputs, of a service ") +
                       writers_of(port.type, kinds));
    }
  }
  for (const InputConfig& input : service.inputs) {
    const auto found = index.find(input.service);
    if (found == index.end()) {
      std::vector<std::string> names;
      for (const auto& [name, unused] : index) names.push_back(name);
      problems.add(input.position, "the input '" + input.service + "' of service '" + service.name +
                                       "' does not exist" + suggestion(input.service, names));
      continue;
    }
    const ServiceConfig& writer = services[found->second];
    const InputPort* port = service.info == nullptr ? nullptr : service.info->input(input.port);
    if (writer.info == nullptr || (port == nullptr && !writer.outputs.empty())) continue;
    if (writer.external() && writer.outputs.front().type.empty()) continue;  // has been said
    const std::string wanted = port == nullptr ? "messages" : port->type;
    if (writer.output(wanted) == nullptr) {
      problems.add(input.position, mismatch(writer, service, wanted, kinds));
    }
  }
}

/// `inputs: all` stands for every service that gives anything.
void expand_all(ServiceConfig& observer, const std::vector<DraftService>& drafts) {
  if (!observer.observes_all) return;
  std::set<std::string> seen;
  for (const DraftService& draft : drafts) {
    const ServiceConfig& other = draft.config;
    const bool gives =
        other.info == nullptr || !other.outputs.empty() || !other.info->outputs.empty();
    if (other.name.empty() || other.observes_all || !gives || !seen.insert(other.name).second) {
      continue;
    }
    observer.inputs.push_back({"", other.name, observer.position});
  }
}

/// Either no service names a host, or each does: it would be open where the others shall run.
void check_hosts(const std::vector<DraftService>& drafts, Problems& problems) {
  const auto named = [](const DraftService& draft) { return !draft.config.host.empty(); };
  if (std::none_of(drafts.begin(), drafts.end(), named)) return;
  for (const DraftService& draft : drafts) {
    if (named(draft)) continue;
    problems.add(draft.config.position, "service '" + draft.config.name +
                                            "' names no host, but others do; add host: NAME");
  }
}

void fill_outputs(ServiceConfig& service, std::string_view name_space) {
  if (service.info == nullptr || service.external()) return;
  for (const OutputPort& port : service.info->outputs) {
    if (!service.info->gives(port, service.parameters)) continue;
    service.outputs.push_back({.type = port.type,
                               .topic = output_topic(name_space, service.name, port.type),
                               .qos = effective_qos(service.qos, port.type),
                               .rate = port.rate});
  }
}

}  // namespace

std::vector<ServiceConfig> wire(const std::vector<DraftService>& drafts,
                                std::string_view name_space, const KindList& kinds,
                                Problems& problems) {
  const Index index = index_names(drafts, problems);
  std::vector<ServiceConfig> services;
  for (const DraftService& draft : drafts) {
    ServiceConfig& service = services.emplace_back(draft.config);
    expand_all(service, drafts);
    fill_outputs(service, name_space);
  }
  const Graph graph(services, name_space);
  const std::set<std::string> in_cycle = check_cycles(graph, problems);
  check_hosts(drafts, problems);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    // In a cycle some type must mismatch too; saying so would only distract.
    if (drafts[i].inputs_are_wrong || in_cycle.contains(services[i].name)) continue;
    check_inputs(services[i], index, services, kinds, problems);
  }
  std::vector<ServiceConfig> ordered;
  if (!problems.empty()) return ordered;
  for (const ServiceConfig* service : graph.order()) ordered.push_back(*service);
  return ordered;
}

}  // namespace quoin
