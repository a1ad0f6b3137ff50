// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/wiring.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "core/parameters/suggestion.hpp"

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

/// Kinds to put one after the other between something that gives `from` and something that reads
/// `to`; nothing when no chain of kinds does it.
std::optional<std::vector<std::string>> kinds_between(MessageType from, MessageType to) {
  std::vector<std::string> chain;
  while (from != to) {
    const auto next = std::find_if(kinds().begin(), kinds().end(),
                                   [&](const KindInfo& kind) { return kind.input == from; });
    if (next == kinds().end() || chain.size() > kinds().size()) return std::nullopt;
    chain.push_back(next->name);
    from = next->output;
  }
  return chain;
}

std::string givers_of(MessageType type) {
  std::string names;
  for (const KindInfo& kind : kinds()) {
    if (kind.output == type) names += (names.empty() ? "" : " or ") + kind.name;
  }
  return names;
}

std::string mismatch(const DraftService& source, const DraftService& reader) {
  const MessageType given = source.kind->output;
  const MessageType wanted = reader.kind->input;
  if (given == MessageType::none) {
    return "'" + source.config.name + "' of kind " + source.kind->name +
           " publishes nothing; name a service of kind " + givers_of(wanted);
  }
  std::string text = "'" + source.config.name + "' gives " + std::string(message_name(given)) +
                     " but " + reader.kind->name + " reads " + std::string(message_name(wanted));
  const auto chain = kinds_between(given, wanted);
  if (!chain) return text + "; name a service of kind " + givers_of(wanted);
  std::string kinds_text;
  for (const std::string& kind : *chain) {
    kinds_text += (kinds_text.empty() ? "a " : " and a ") + kind;
  }
  return text + "; put " + kinds_text + " between";
}

/// Services that are part of a circle of inputs; each circle is reported once.
std::set<std::size_t> find_cycles(const std::vector<DraftService>& drafts, const Index& index,
                                  Problems& problems) {
  std::set<std::size_t> in_cycle;
  for (std::size_t start = 0; start < drafts.size(); ++start) {
    if (in_cycle.contains(start)) continue;
    // Every service has one input at most, so a circle through `start` is found by following
    // inputs.
    std::vector<std::size_t> path{start};
    while (path.size() <= drafts.size()) {
      const auto next = index.find(drafts[path.back()].config.input);
      if (next == index.end()) break;
      if (next->second == start) {
        in_cycle.insert(path.begin(), path.end());
        if (path.size() == 1) {
          problems.add(drafts[start].input_at,
                       "'" + drafts[start].config.name +
                           "' reads itself; name another service as its input");
          break;
        }
        std::string text = "cycle: '" + drafts[start].config.name + "'";
        for (std::size_t i = 1; i < path.size(); ++i) {
          text += " reads '" + drafts[path[i]].config.name + "'";
        }
        text += " reads '" + drafts[start].config.name + "'; start from a source of scans";
        problems.add(drafts[start].input_at, text);
        break;
      }
      path.push_back(next->second);
    }
  }
  return in_cycle;
}

void check_input(const DraftService& service, const std::vector<DraftService>& drafts,
                 const Index& index, Problems& problems) {
  const std::string& input = service.config.input;
  if (service.input_at.line == 0) {
    if (service.kind != nullptr && service.kind->input != MessageType::none) {
      problems.add(service.config.position, "service '" + service.config.name + "' of kind " +
                                                service.kind->name + " needs an input that gives " +
                                                std::string(message_name(service.kind->input)) +
                                                "; add input: NAME of a service of kind " +
                                                givers_of(service.kind->input));
    }
    return;
  }
  if (service.kind != nullptr && service.kind->input == MessageType::none) {
    problems.add(service.input_at,
                 "kind " + service.kind->name +
                     " is a source and reads no other service; remove the input of '" +
                     service.config.name + "'");
    return;
  }
  const auto found = index.find(input);
  if (found == index.end()) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : index) names.push_back(name);
    problems.add(service.input_at, "the input '" + input + "' of service '" + service.config.name +
                                       "' does not exist" + suggestion(input, names));
    return;
  }
  const DraftService& source = drafts[found->second];
  if (service.kind != nullptr && source.kind != nullptr &&
      source.kind->output != service.kind->input) {
    problems.add(service.input_at, mismatch(source, service));
  }
}

/// Either no service names a host, or each does: nobody could tell where the others shall run.
void check_hosts(const std::vector<DraftService>& drafts, Problems& problems) {
  const auto named = [](const DraftService& draft) { return !draft.config.host.empty(); };
  if (std::none_of(drafts.begin(), drafts.end(), named)) return;
  for (const DraftService& draft : drafts) {
    if (named(draft)) continue;
    problems.add(draft.config.position, "service '" + draft.config.name +
                                            "' names no host, but others do; add host: NAME");
  }
}

}  // namespace

std::vector<ServiceConfig> wire(const std::vector<DraftService>& drafts, Problems& problems) {
  const Index index = index_names(drafts, problems);
  const std::set<std::size_t> in_cycle = find_cycles(drafts, index, problems);
  check_hosts(drafts, problems);
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    // In a circle some type must mismatch too; saying so would only distract.
    if (!in_cycle.contains(i)) check_input(drafts[i], drafts, index, problems);
  }
  std::vector<ServiceConfig> ordered;
  if (!problems.empty()) return ordered;

  std::vector<const DraftService*> left;
  for (const DraftService& draft : drafts) left.push_back(&draft);
  const auto waits_for = [&](const DraftService& draft, const DraftService& other) {
    return other.config.name == draft.config.input ||
           (other.config.name == draft.config.name &&
            other.config.strength > draft.config.strength);
  };
  while (!left.empty()) {
    const auto next = std::find_if(left.begin(), left.end(), [&](const DraftService* draft) {
      return std::none_of(left.begin(), left.end(),
                          [&](const DraftService* other) { return waits_for(*draft, *other); });
    });
    if (next == left.end()) {
      problems.add(left.front()->config.position,
                   "cycle: '" + left.front()->config.name +
                       "' reads itself by way of other instances; start from a source of scans");
      return {};
    }
    ordered.push_back((*next)->config);
    left.erase(next);
  }
  return ordered;
}

}  // namespace quoin
