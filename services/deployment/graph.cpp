// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/graph.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "services/topics/topic_types.hpp"

namespace quoin {

namespace {

bool observes(const ServiceConfig& service) {
  return service.observes_all || (!service.inputs.empty() && service.inputs.front().port.empty());
}

/// What a port of `type` reads of `writer`, whose kind may not be known.
OutputConfig output_of(const ServiceConfig& writer, std::string_view type,
                       std::string_view name_space) {
  if (const OutputConfig* output = writer.output(type)) return *output;
  return {.type = std::string(type),
          .topic = output_topic(name_space, writer.name, type),
          .qos = effective_qos(writer.qos, type)};
}

/// What `observer` may find there: of a kind that nobody knows here any type there is.
std::vector<OutputConfig> outputs_of(const ServiceConfig& writer, const ServiceConfig& observer,
                                     std::string_view name_space) {
  if (writer.info != nullptr) return writer.outputs;
  std::vector<OutputConfig> outputs;
  const bool knows = observer.info != nullptr && observer.info->known_outputs != nullptr;
  if (const KindInfo* known = knows ? observer.info->known_outputs(writer.kind) : nullptr) {
    for (const OutputPort& port : known->outputs) {
      if (known->gives(port, writer.parameters)) {
        outputs.push_back(output_of(writer, port.type, name_space));
      }
    }
    return outputs;
  }
  for (const topics::TopicType& type : topics::topic_types()) {
    outputs.push_back(output_of(writer, type.name, name_space));
  }
  return outputs;
}

}  // namespace

Graph::Graph(const std::vector<ServiceConfig>& services, std::string_view name_space)
    : services_(services), name_space_(name_space) {
  for (const ServiceConfig& service : services) {
    const auto [known, added] = by_name_.try_emplace(service.name, &service);
    if (!added && service.strength > known->second->strength) known->second = &service;
  }
  for (const ServiceConfig* service : order()) {
    int level = 0;
    for (const InputConfig& input : service->inputs) {
      const auto writer = levels_.find(input.service);
      if (writer != levels_.end()) level = std::max(level, writer->second + 1);
    }
    int& of_name = levels_[service->name];  // of the last of its instances
    of_name = std::max(of_name, level);
  }
  int last = 0;
  for (const auto& [name, level] : levels_) last = std::max(last, level);
  for (const ServiceConfig& service : services) {
    if (observes(service)) levels_[service.name] = last + 1;
  }
}

const ServiceConfig* Graph::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

std::vector<Connection> Graph::inputs_of(const ServiceConfig& service) const {
  std::vector<Connection> connections;
  for (const InputConfig& input : service.inputs) {
    const ServiceConfig* writer = find(input.service);
    if (writer == nullptr) continue;
    if (input.port.empty() && observes(service)) {
      for (const OutputConfig& output : outputs_of(*writer, service, name_space_)) {
        connections.push_back({&service, "", output.type, Join::each, writer, output});
      }
      continue;
    }
    const InputPort* port = service.info == nullptr ? nullptr : service.info->input(input.port);
    Connection connection{.reader = &service, .port = input.port, .writer = writer};
    if (port != nullptr) {
      connection.type = port->type;
      connection.join = port->join;
      connection.output = output_of(*writer, port->type, name_space_);
    }
    connections.push_back(std::move(connection));
  }
  return connections;
}

std::vector<const ServiceConfig*> Graph::readers_of(std::string_view name,
                                                    std::string_view type) const {
  std::vector<const ServiceConfig*> readers;
  for (const ServiceConfig& service : services_) {
    const auto connections = inputs_of(service);
    if (std::any_of(connections.begin(), connections.end(), [&](const Connection& connection) {
          return connection.writer->name == name && (type.empty() || connection.type == type);
        })) {
      readers.push_back(&service);
    }
  }
  return readers;
}

std::size_t Graph::expected_readers(const ServiceConfig& service) const {
  std::size_t count = 0;
  for (const ServiceConfig& reader : services_) {
    for (const InputConfig& input : reader.inputs) {
      if (input.service != service.name) continue;
      count += observes(reader) ? service.outputs.size() : 1;
    }
  }
  return count;
}

std::optional<Connection> Graph::driving_input(const ServiceConfig& service) const {
  for (Connection& connection : inputs_of(service)) {
    if (connection.join == Join::each && !connection.port.empty()) return std::move(connection);
  }
  return std::nullopt;
}

const ServiceConfig& Graph::source_of(const ServiceConfig& service) const {
  const ServiceConfig* origin = &service;
  // No way is longer than all services together, should there be a cycle.
  for (std::size_t steps = services_.size(); steps > 0; --steps) {
    const auto input = driving_input(*origin);
    if (!input) break;
    origin = input->writer;
  }
  return *origin;
}

const ServiceConfig* Graph::upstream(const ServiceConfig& service, std::string_view type) const {
  const ServiceConfig* candidate = &service;
  for (std::size_t steps = services_.size(); steps > 0; --steps) {
    if (candidate->output(type) != nullptr) return candidate;
    const auto input = driving_input(*candidate);
    if (!input) break;
    candidate = input->writer;
  }
  return nullptr;
}

std::vector<Connection> Graph::path_to(const ServiceConfig& service,
                                       const OutputConfig& output) const {
  std::vector<Connection> path{{.type = output.type, .writer = &service, .output = output}};
  while (path.back().output.rate == Rate::per_input && path.size() <= services_.size()) {
    auto input = driving_input(*path.back().writer);
    if (!input) break;
    path.push_back(std::move(*input));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

int Graph::level(const ServiceConfig& service) const {
  const auto known = levels_.find(service.name);
  return known == levels_.end() ? 0 : known->second;
}

int Graph::level(const ProcessConfig& process) const {
  int lowest = std::numeric_limits<int>::max();
  for (const ServiceConfig* service : process.services) lowest = std::min(lowest, level(*service));
  return lowest;
}

std::vector<Connection> Graph::ends() const {
  std::vector<Connection> ends;
  std::set<std::pair<std::string, std::string>> read;
  for (const ServiceConfig& service : services_) {
    if (observes(service)) continue;
    for (const Connection& connection : inputs_of(service)) {
      read.emplace(connection.writer->name, connection.type);
    }
  }
  for (const ServiceConfig& service : services_) {
    if (service.external() || by_name_.at(service.name) != &service) continue;
    for (const OutputConfig& output : service.outputs) {
      if (read.contains({service.name, output.type})) continue;
      ends.push_back({.type = output.type, .writer = &service, .output = output});
    }
  }
  return ends;
}

std::vector<const ServiceConfig*> Graph::order() const {
  std::vector<const ServiceConfig*> left;
  std::vector<const ServiceConfig*> ordered;
  for (const ServiceConfig& service : services_) left.push_back(&service);
  const auto waits_for = [](const ServiceConfig& service, const ServiceConfig& other) {
    return std::any_of(service.inputs.begin(), service.inputs.end(),
                       [&](const InputConfig& input) { return input.service == other.name; }) ||
           (other.name == service.name && other.strength > service.strength);
  };
  while (true) {
    const auto next = std::find_if(left.begin(), left.end(), [&](const ServiceConfig* service) {
      return std::none_of(left.begin(), left.end(),
                          [&](const ServiceConfig* other) { return waits_for(*service, *other); });
    });
    if (next == left.end()) return ordered;
    ordered.push_back(*next);
    left.erase(next);
  }
}

std::vector<std::vector<const ServiceConfig*>> Graph::cycles() const {
  std::vector<std::vector<const ServiceConfig*>> cycles;
  std::set<std::string, std::less<>> in_cycle;
  std::vector<const ServiceConfig*> path;
  std::set<std::string, std::less<>> left_behind;  // no further cycle goes through these
  const auto visit = [&](const auto& self, const ServiceConfig& service) -> void {
    const auto on_path = std::find_if(path.begin(), path.end(), [&](const ServiceConfig* other) {
      return other->name == service.name;
    });
    if (on_path != path.end()) {
      const bool reported = std::any_of(on_path, path.end(), [&](const ServiceConfig* other) {
        return in_cycle.contains(other->name);
      });
      if (!reported) cycles.emplace_back(on_path, path.end());
      for (auto at = on_path; at != path.end(); ++at) in_cycle.insert((*at)->name);
      return;
    }
    if (left_behind.contains(service.name)) return;
    path.push_back(&service);
    for (const InputConfig& input : service.inputs) {
      if (const ServiceConfig* writer = find(input.service)) self(self, *writer);
    }
    path.pop_back();
    left_behind.insert(service.name);
  };
  for (const ServiceConfig& service : services_) visit(visit, service);
  return cycles;
}

}  // namespace quoin
