// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/deployment/process_entries.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "core/parameters/parameter.hpp"
#include "services/deployment/service_entries.hpp"

namespace quoin {

namespace {

/// Whether both need the same device.
bool same_device(const ServiceConfig& one, const ServiceConfig& other) {
  if (one.kind != other.kind || one.info == nullptr || one.info->device.empty()) return false;
  const auto device = [](const ServiceConfig& service) {
    for (const ParameterSetting& setting : service.parameters) {
      if (setting.name == service.info->device) return setting.text;
    }
    for (const ParameterInfo& info : service.info->parameters) {
      if (info.name == service.info->device) return info.default_value;
    }
    return std::string();
  };
  return !device(one).empty() && device(one) == device(other);
}

class ProcessReader {
 public:
  ProcessReader(std::vector<DraftService>& drafts, Problems& problems)
      : drafts_(drafts), problems_(problems) {}

  void read(const Entry& process) {
    check_name(process);
    if (!process.value.IsSequence() || process.value.size() == 0) {
      problems_.add(process.value_at, "process '" + process.key +
                                          "' must be a list of services, such as [walls, corners]");
      return;
    }
    members_.clear();
    for (const Entry& service : read_list(process, problems_)) {
      read_member(process.key, service.value.Scalar(), service.value_at);
    }
  }

 private:
  void check_name(const Entry& process) {
    if (process.key.empty() || process.key.size() > longest_name ||
        !only_of(process.key, "abcdefghijklmnopqrstuvwxyz0123456789_")) {
      problems_.add(process.key_at, "the process name '" + process.key + "' must be 1 to " +
                                        std::to_string(longest_name) +
                                        " of the characters a-z, 0-9 and _");
    }
    if (std::ranges::any_of(
            drafts_, [&](const DraftService& draft) { return draft.config.name == process.key; })) {
      problems_.add(process.key_at,
                    "process '" + process.key + "' has the name of a service; choose another one");
    }
  }

  void read_member(const std::string& process, const std::string& service, Position at) {
    DraftService* const draft = find(process, service, at);
    if (draft == nullptr) return;
    ServiceConfig& config = draft->config;
    const auto [place, added] = placed_.emplace(service, at);
    if (!added) {
      problems_.add(at, "service '" + service + "' is in process '" + config.process + "' at " +
                            std::to_string(place->second.line) + ":" +
                            std::to_string(place->second.column) +
                            " already; a service runs in one process");
      return;
    }
    config.process = process;
    if (config.external()) {
      problems_.add(at, "service '" + service +
                            "' of kind external is not ours to run; remove it from process '" +
                            process + "'");
      return;
    }
    const auto conflict = std::ranges::find_if(members_, [&](const DraftService* other) {
      return !check_together(process, other->config, config, at);
    });
    if (conflict == members_.end()) members_.push_back(draft);
  }

  DraftService* find(const std::string& process, const std::string& service, Position at) {
    std::vector<std::string> names;
    bool has_instances = false;
    for (DraftService& draft : drafts_) {
      if (label(draft.config) == service) return &draft;
      names.push_back(label(draft.config));
      has_instances = has_instances || draft.config.name == service;
    }
    problems_.add(at, has_instances
                          ? "service '" + service + "' has several instances; name one, such as " +
                                service + "@" + strength_of(service)
                          : "service '" + service + "' of process '" + process +
                                "' does not exist" + suggestion(service, names));
    return nullptr;
  }

  [[nodiscard]] std::string strength_of(const std::string& service) const {
    for (const DraftService& draft : drafts_) {
      if (draft.config.name == service) return std::to_string(draft.config.strength.value_or(0));
    }
    return "";
  }

  /// False, and a problem, when they cannot share a process.
  bool check_together(const std::string& process, const ServiceConfig& one,
                      const ServiceConfig& other, Position at) {
    const std::string both = "'" + label(one) + "' and '" + label(other) + "' ";
    if (one.host != other.host) {
      problems_.add(at, both + "run on different hosts (" + one.host + ", " + other.host +
                            ") and cannot share process '" + process + "'");
    } else if (one.restart != other.restart) {
      problems_.add(at, both + "differ in restart, which counts for the whole process '" + process +
                            "'; give them the same");
    } else if (same_device(one, other)) {
      problems_.add(at, both + "of kind " + one.kind +
                            " use the same device; remove one of them from process '" + process +
                            "'");
    } else {
      return true;
    }
    return false;
  }

  std::vector<DraftService>& drafts_;
  Problems& problems_;
  std::map<std::string, Position> placed_;  // by label
  std::vector<const DraftService*> members_;
};

}  // namespace

void read_processes(const Entry& entry, std::vector<DraftService>& drafts, Problems& problems) {
  if (!entry.value.IsMap()) {
    problems.add(entry.value_at,
                 "'processes' must be a map of names and lists of services, such as {perception: "
                 "[walls, corners]}, not " +
                     what_is(entry.value));
    return;
  }
  ProcessReader reader(drafts, problems);
  for (const Entry& process : entries_of(entry.value, "'processes'", problems)) {
    reader.read(process);
  }
}

}  // namespace quoin
