// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/plan.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "core/parameters/parameter.hpp"
#include "services/deployment/graph.hpp"

namespace quoin::deploy {

namespace {

/// What of the service runs on `host`; null when nothing does.
const ServiceConfig* find(const Deployment& deployment, std::string_view name,
                          const std::string& host) {
  const auto found = std::find_if(
      deployment.services.begin(), deployment.services.end(), [&](const ServiceConfig& service) {
        return label(service) == name && service.host == host && service.has_process();
      });
  return found == deployment.services.end() ? nullptr : &*found;
}

std::string arrow(const std::string& what, const std::string& from, const std::string& to) {
  return what + " " + from + " -> " + to;
}

std::string policy_name(RestartPolicy policy) {
  return policy == RestartPolicy::always ? "always" : "never";
}

std::string settings_text(const ParameterSettings& settings) {
  std::string text;
  for (const ParameterSetting& setting : settings) {
    text += (text.empty() ? "" : ", ") + setting.name + "=" + setting.text;
  }
  return text;
}

std::filesystem::path folder_of(const Deployment& deployment) {
  return std::filesystem::weakly_canonical(std::filesystem::absolute(deployment.file))
      .parent_path();
}

/// Relative paths count from the folder of the deployment file.
bool names_a_file(const ServiceConfig& service, const Deployment& deployment) {
  const KindInfo& kind = *service.info;
  for (const ParameterSetting& setting : service.parameters) {
    const auto info =
        std::find_if(kind.parameters.begin(), kind.parameters.end(),
                     [&](const ParameterInfo& known) { return known.name == setting.name; });
    if (info == kind.parameters.end() || info->type != ParameterType::text) continue;
    if (setting.text.empty() || std::filesystem::path(setting.text).is_absolute()) continue;
    std::error_code ignored;
    if (std::filesystem::exists(folder_of(deployment) / setting.text, ignored)) return true;
  }
  return false;
}

/// "front", or "lines, pose" of an observer, "lines=wctls, odometry=front" of several ports.
std::string inputs_text(const ServiceConfig& service) {
  std::string text;
  for (const InputConfig& input : service.inputs) {
    text += text.empty() ? "" : ", ";
    if (service.inputs.size() > 1 && !input.port.empty()) text += input.port + "=";
    text += input.service;
  }
  return text;
}

std::string qos_text(const std::vector<OutputConfig>& outputs) {
  std::string text;
  for (const OutputConfig& output : outputs) text += (text.empty() ? "" : ", ") + output.qos;
  return text;
}

/// Other services behind its ports, or the same ones with another QoS; and its own QoS.
void append_input_changes(const Deployment& running, const ServiceConfig& now,
                          const Deployment& wanted, const ServiceConfig& then,
                          std::vector<std::string>& reasons) {
  if (now.inputs != then.inputs) {
    reasons.push_back(arrow("input", inputs_text(now), inputs_text(then)));
  }
  if (now.kind == then.kind && now.outputs != then.outputs) {
    reasons.push_back(arrow("qos", qos_text(now.outputs), qos_text(then.outputs)));
  }
  if (now.inputs != then.inputs || now.kind != then.kind) return;
  const auto before = Graph(running).inputs_of(now);
  const auto after = Graph(wanted).inputs_of(then);
  for (std::size_t i = 0; i < before.size() && i < after.size(); ++i) {
    const OutputConfig& from = before[i].output;
    const OutputConfig& to = after[i].output;
    if (from.qos != to.qos) {
      reasons.push_back(arrow("qos of " + after[i].writer->name, from.qos, to.qos));
    } else if (from != to) {
      reasons.push_back(arrow("topic of " + after[i].writer->name, from.topic, to.topic));
    }
  }
}

const std::string& state_form(const ServiceConfig& service) {
  static const std::string none;
  for (const MethodInfo& method : service.info->methods) {
    if (method.name == service.method) return method.state;
  }
  return none;
}

/// What a service has learned and its successor cannot go on with.
std::string dropped_state(const ServiceConfig& now, const ServiceConfig& then) {
  const std::string& form = state_form(now);
  if (form.empty() || (now.kind == then.kind && form == state_form(then))) return "";
  return ", drops its state (" + form + ")";
}

/// Why a running process cannot become what is wanted; "" when it can.
std::string reason_to_replace(const Deployment& running, const ServiceConfig& now,
                              const Deployment& wanted, const ServiceConfig& then) {
  std::vector<std::string> reasons;
  if (now.kind != then.kind) reasons.push_back(arrow("kind", now.kind, then.kind));
  if (now.program != then.program) reasons.push_back("program");
  if (now.process != then.process) {
    const auto name = [](const ServiceConfig& service) {
      return service.process.empty() ? "its own" : service.process;
    };
    reasons.push_back(arrow("process", name(now), name(then)));
  }
  append_input_changes(running, now, wanted, then, reasons);
  const KindInfo& kind = *then.info;
  if (now.kind == then.kind && kind.methods.empty()) {
    const std::string changed =
        settings_text(changed_settings(kind.parameters, now.parameters, then.parameters));
    if (!changed.empty()) reasons.push_back(changed);
    if (folder_of(running) != folder_of(wanted) &&
        (names_a_file(now, running) || names_a_file(then, wanted))) {
      reasons.push_back("its files are in " + folder_of(wanted).string());
    }
  }
  std::string text;
  for (const std::string& reason : reasons) text += (text.empty() ? "" : ", ") + reason;
  return text;
}

std::string reason_to_swap(const ServiceConfig& now, const ServiceConfig& then) {
  if (then.method.empty()) return "";
  const bool same_method = now.method == then.method;
  const std::string changed = settings_text(
      changed_settings(parameters_of(*then.info, then.method),
                       same_method ? now.parameters : ParameterSettings{}, then.parameters));
  if (same_method) return changed;
  return arrow("method", now.method, then.method) + (changed.empty() ? "" : ", " + changed);
}

/// Whether readers of the output would no longer match its writers.
bool claim_differs(const Deployment& running, const ServiceConfig& then) {
  return std::any_of(
      running.services.begin(), running.services.end(), [&](const ServiceConfig& now) {
        return now.name == then.name && (now.strength.has_value() != then.strength.has_value() ||
                                         (now.strength && now.lease != then.lease));
      });
}

/// The new process has the new method from its start.
Change replacement(const Deployment& running, const ServiceConfig& now, const Deployment& wanted,
                   const ServiceConfig& then, std::string reason) {
  const std::string swapped = now.kind == then.kind ? reason_to_swap(now, then) : "";
  if (!swapped.empty()) reason += ", " + swapped;
  return {ChangeAction::replace, label(then), reason + dropped_state(now, then),
          Graph(running).source_of(now).name == Graph(wanted).source_of(then).name};
}

Change change_of(const Deployment& running, const Deployment& wanted, const ServiceConfig& then) {
  const ServiceConfig* now = find(running, label(then), then.host);
  if (now == nullptr) {
    std::string detail = then.kind;
    if (!then.method.empty()) detail += "/" + then.method;
    if (!then.inputs.empty()) detail += " reads " + inputs_text(then);
    return {ChangeAction::start, label(then), detail};
  }
  if (std::string reason = reason_to_replace(running, *now, wanted, then); !reason.empty()) {
    return replacement(running, *now, wanted, then, std::move(reason));
  }
  const std::string policy =
      now->restart == then.restart
          ? ""
          : arrow("restart", policy_name(now->restart), policy_name(then.restart));
  if (std::string reason = reason_to_swap(*now, then); !reason.empty()) {
    return {ChangeAction::swap, label(then),
            reason + dropped_state(*now, then) + (policy.empty() ? "" : ", " + policy)};
  }
  if (!policy.empty()) return {ChangeAction::adjust, label(then), policy};
  return {ChangeAction::keep, label(then), ""};
}

/// A process of several services cannot lose or gain one while it runs: where one of them is to be
/// started, replaced or stopped, a new process takes over from the whole.
void replace_whole_processes(const Deployment& running, const Deployment& wanted,
                             const std::string& host, std::vector<Change>& changes) {
  const auto config_in = [&](const Deployment& deployment, const Change& change) {
    const ServiceConfig* service = find(deployment, change.service, host);
    return service != nullptr && !service->process.empty() ? service : nullptr;
  };
  bool any = true;
  while (any) {
    any = false;
    std::set<std::string> old_processes;
    std::set<std::string> new_processes;
    for (const Change& change : changes) {
      const bool stays = change.action != ChangeAction::start &&
                         change.action != ChangeAction::replace &&
                         change.action != ChangeAction::stop;
      if (stays) continue;
      if (const auto* now = config_in(running, change)) old_processes.insert(now->process);
      if (const auto* then = config_in(wanted, change)) new_processes.insert(then->process);
    }
    for (Change& change : changes) {
      const ServiceConfig* now = config_in(running, change);
      const ServiceConfig* then = config_in(wanted, change);
      if (now == nullptr || then == nullptr || change.action == ChangeAction::replace) continue;
      if (!old_processes.contains(now->process) && !new_processes.contains(then->process)) continue;
      change = replacement(running, *now, wanted, *then, "with its process " + then->process);
      any = true;
    }
  }
}

}  // namespace

std::string_view action_name(ChangeAction action) {
  switch (action) {
    case ChangeAction::keep:
      return "keep";
    case ChangeAction::adjust:
      return "adjust";
    case ChangeAction::swap:
      return "swap";
    case ChangeAction::start:
      return "start";
    case ChangeAction::replace:
      return "replace";
    case ChangeAction::stop:
      return "stop";
  }
  return "unknown";
}

const Change& Plan::of(std::string_view service) const {
  for (const Change& change : changes) {
    if (change.service == service) return change;
  }
  throw std::out_of_range("no service '" + std::string(service) + "' in the plan");
}

bool Plan::replaces(std::string_view service) const {
  return std::any_of(changes.begin(), changes.end(), [&](const Change& change) {
    return change.service == service && change.action == ChangeAction::replace;
  });
}

bool Plan::stops(std::string_view service) const {
  return std::any_of(changes.begin(), changes.end(), [&](const Change& change) {
    return change.service == service && change.action == ChangeAction::stop;
  });
}

bool Plan::nothing_to_do() const {
  return std::all_of(changes.begin(), changes.end(), [](const Change& change) {
    return change.action == ChangeAction::keep || change.action == ChangeAction::adjust;
  });
}

Plan plan_changes(const Deployment& running, const Deployment& wanted, const std::string& host) {
  Plan plan;
  const auto obstacle = [&](const std::string& what) {
    plan.obstacles.push_back(wanted.file.string() + ": " + what +
                             " while the deployment runs; end it and start it anew with quoin up");
  };
  if (running.name_space != wanted.name_space) {
    obstacle("the namespace cannot be changed from '" + running.name_space + "' to '" +
             wanted.name_space + "'");
  }
  if (running.domain != wanted.domain) {
    obstacle("the domain cannot be changed from " + std::to_string(running.domain) + " to " +
             std::to_string(wanted.domain));
  }
  if (running.network != wanted.network) obstacle("the network cannot be changed");
  if (running.security != wanted.security) obstacle("security cannot be changed");
  if (running.ros != wanted.ros) obstacle("the distribution of ROS 2 cannot be changed");
  for (const ServiceConfig& service : wanted.services) {
    if (service.host != host || !service.has_process()) continue;
    plan.changes.push_back(change_of(running, wanted, service));
  }
  for (const ServiceConfig& service : running.services) {
    if (service.host == host && service.has_process() &&
        find(wanted, label(service), host) == nullptr) {
      plan.changes.push_back({ChangeAction::stop, label(service), ""});
    }
  }
  replace_whole_processes(running, wanted, host, plan.changes);
  for (const Change& change : plan.changes) {
    const ServiceConfig* service = find(wanted, change.service, host);
    if (service == nullptr) continue;
    // Of two writers of one strength the readers hear one, until that is gone.
    if (change.action == ChangeAction::replace && service->strength) {
      obstacle("service '" + change.service + "' has a strength, and cannot be replaced (" +
               change.detail + ")");
    }
    if (claim_differs(running, *service)) {
      obstacle("strength and lease of service '" + service->name + "' cannot be changed");
    }
  }
  return plan;
}

std::string to_text(const Change& change) {
  std::string text(action_name(change.action));
  text += " " + change.service;
  return change.detail.empty() ? text : text + ": " + change.detail;
}

}  // namespace quoin::deploy
