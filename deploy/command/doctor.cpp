// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <exception>
#include <iostream>
#include <memory>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "deploy/command/commands.hpp"
#include "deploy/command/network_options.hpp"
#include "deploy/diagnostics/host_checks.hpp"
#include "deploy/diagnostics/network_checks.hpp"
#include "deploy/diagnostics/shared_memory.hpp"
#include "deploy/observation/heartbeats.hpp"
#include "deploy/orchestration/launch.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/interfaces.hpp"

namespace quoin::deploy {

namespace {

namespace fs = std::filesystem;

struct DoctorOptions {
  std::string file;
  NetworkOptions network;
  double wait = 2.5;  // [s] heartbeats come once a second
  bool fix = false;
  bool json = false;
};

void append(Checks& checks, Checks more) {
  std::move(more.begin(), more.end(), std::back_inserter(checks));
}

Checks check_interfaces(const NetworkConfig& network) {
  std::vector<NamedInterface> interfaces;
  for (const runtime::InterfaceAddress& each :
       runtime::named_interfaces(network.interfaces, runtime::host_addresses())) {
    interfaces.push_back({each.interface, each.address, each.running});
  }
  return check_network(network, interfaces, "/sys/class/net", "/proc/net/route");
}

Checks check_disks(const DoctorOptions& options) {
  std::set<fs::path> folders{fs::current_path(), fs::temp_directory_path()};
  if (!options.file.empty()) folders.insert(fs::absolute(options.file).parent_path());
  Checks checks;
  for (const fs::path& folder : folders) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    if (!error) checks.push_back(check_disk(folder, space.capacity, space.available));
  }
  return checks;
}

struct Heard {
  std::vector<HeardProcess> processes;  ///< that live at the end of the listening
  std::vector<std::string> foreign_writers;
  std::vector<std::string> unreadable;  ///< HeartbeatListener::unreadable
};

Heard listen(const Deployment& deployment, bool all_namespaces, double wait) {
  HeartbeatListener listener(deployment, "quoin_doctor", all_namespaces);
  listener.listen(wait, [] { return false; });
  const auto now = std::chrono::steady_clock::now();
  Heard result;
  std::vector<const msg::ServiceStatus*> living;
  for (const auto& [key, heard] : listener.heard()) {
    const msg::ServiceStatus& status = heard.newest;
    const bool ended =
        status.state() == msg::STATE_FINISHED || status.state() == msg::STATE_STOPPED;
    // One heartbeat is missed at least.
    if (ended || now - heard.last > std::chrono::milliseconds(1500)) continue;
    living.push_back(&status);
    result.processes.push_back({key.first + "/" + status.service(), status.host(), status.pid(),
                                status.incarnation(), status.state() == msg::STATE_ACTIVE,
                                heard.fresh, heard.delay, status.incompatible_qos(),
                                input_complaints(status), line_scatter_of(status)});
  }
  result.foreign_writers = foreign_writers(living);
  result.unreadable = listener.unreadable();
  return result;
}

Checks check_services(const Deployment& deployment, bool all_namespaces, double wait) {
  try {
    const auto [processes, strangers, unreadable] = listen(deployment, all_namespaces, wait);
    Checks checks = check_clocks(processes, runtime::host_name());
    append(checks, check_doubles(processes));
    append(checks, check_strangers(processes, strangers));
    append(checks, check_qos(processes, unreadable));
    append(checks, check_line_scatter(processes));
    if (processes.empty()) checks.push_back({"deployments", Verdict::good, "no service runs", ""});
    return checks;
  } catch (const std::exception& error) {
    return {{"deployments", Verdict::bad, std::string("cannot listen to them: ") + error.what(),
             "see the network checks"}};
  }
}

int run(const DoctorOptions& options, bool one_namespace) {
  const Deployment deployment = deployment_to_reach(options.network, options.file);
  auto stale = stale_files("/dev/shm", "/proc");
  std::size_t removed = 0;
  if (options.fix && !stale.empty()) {
    removed = remove(stale);
    stale = stale_files("/dev/shm", "/proc");
  }
  Checks checks{check_shared_memory(stale)};
  if (removed > 0) checks.back().text += "; " + std::to_string(removed) + " were removed";
  append(checks, check_interfaces(deployment.network));
  append(checks, check_ros2(deployment, ros2::look_around()));
  checks.push_back(check_socket_buffers("/proc/sys/net/core", runtime::socket_buffer_bytes));
  // Without security nothing is sent that has to be put together again.
  if (deployment.security && !deployment.network.interfaces.empty()) {
    checks.push_back(check_reassembly("/proc/sys/net/ipv4"));
  }
  append(checks, check_disks(options));
  checks.push_back(check_programs(program_folder()));
  checks.push_back(check_orphans("/proc"));
  if (one_namespace) checks.push_back(check_supervisor(deployment, "/proc/net/unix", "/proc"));
  append(checks, check_services(deployment, !one_namespace, options.wait));

  const bool healthy = all_good(checks);
  if (options.json) {
    const nlohmann::ordered_json object{
        {"healthy", healthy}, {"removed_files", removed}, {"checks", to_json(checks)}};
    std::cout << object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
              << '\n';
  } else {
    for (const Check& check : checks) print(check, std::cout);
    std::cout << (healthy ? "nothing is wrong\n" : "see the arrows for what to do\n");
  }
  return healthy ? exit_ok : exit_failure;
}

}  // namespace

Command add_doctor(CLI::App& app) {
  CLI::App* line = app.add_subcommand(
      "doctor", "Tell what is wrong with this host and the network, and what to do");
  const auto options = std::make_shared<DoctorOptions>();
  CLI::Option* file = line->add_option("file", options->file, "Deployment file (YAML)");
  add_network_options(*line, options->network, file);
  const CLI::Option* name_space = line->get_option("--namespace");
  line->add_option("--wait", options->wait, "How long to listen to the services [s]")
      ->capture_default_str()
      ->transform(a_time());
  line->add_flag("--fix", options->fix,
                 "Remove stale shared-memory files of this user; nothing else is changed");
  line->add_flag("--json", options->json, "As a JSON object");
  return {line, [=] { return run(*options, file->count() + name_space->count() > 0); }};
}

}  // namespace quoin::deploy
