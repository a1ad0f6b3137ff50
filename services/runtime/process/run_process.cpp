// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/process/run_process.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "core/parameters/parameter.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/process/log.hpp"
#include "services/runtime/process/service.hpp"

namespace quoin::runtime {

namespace {

std::vector<Component>& registry() {
  static std::vector<Component> components;
  return components;
}

std::vector<Companion::Functions>& companions() {
  static std::vector<Companion::Functions> registered;
  return registered;
}

struct Options {
  std::string deployment;
  std::string deployment_name;
  std::string service;
  std::string process;
  std::vector<std::string> observers;
  std::optional<double> longest_wait;  // [s]
  bool held = false;

  [[nodiscard]] const std::string& name() const { return process.empty() ? service : process; }
};

/// By label of the service, how many readers outside the deployment to wait for; "" for all.
std::map<std::string, std::size_t> parse_observers(const std::vector<std::string>& texts) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::string service = equals == std::string::npos ? "" : text.substr(0, equals);
    const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    if (number.empty() || number.size() > 6 ||
        number.find_first_not_of("0123456789") != std::string::npos) {
      throw CLI::ValidationError("--observers", "'" + text + "' is no COUNT or SERVICE=COUNT");
    }
    counts[service] += std::stoul(number);
  }
  return counts;
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--deployment", options.deployment, "Deployment file (YAML)")->required();
  CLI::Option* const service =
      app.add_option("--service", options.service, "Name of this service in it");
  CLI::Option* const process = app.add_option(
      "--process", options.process, "Name of this process in it, to run all of its services");
  service->excludes(process);
  app.add_option("--observers", options.observers,
                 "Readers outside the deployment to wait for before the first scan: COUNT, or "
                 "SERVICE=COUNT, which may be repeated")
      ->take_all();
  app.add_option("--reader-timeout", options.longest_wait,
                 "Seconds to wait for readers before going on without them (10, with security 30)")
      ->check(CLI::Range(0.0, 3600.0));
  app.add_option("--deployment-name", options.deployment_name,
                 "What the deployment file is a copy of: messages name that, and paths in it count "
                 "from its folder");
  app.add_flag("--held", options.held,
               "Take over from a running process of the services when asked to; publish nothing "
               "before");
}

const Component* find(const std::vector<Component>& components, const std::string& kind) {
  const auto found = std::ranges::find_if(
      components, [&](const Component& component) { return component.kind->name == kind; });
  return found == components.end() ? nullptr : &*found;
}

/// Throws DeploymentError.
std::vector<const ServiceConfig*> services_to_run(const Deployment& deployment,
                                                  const Options& options,
                                                  const std::vector<Component>& components) {
  const auto fail = [&](const std::string& what) {
    throw DeploymentError({deployment.file.string() + ": " + what});
  };
  std::vector<const ServiceConfig*> services;
  std::vector<std::string> candidates;
  for (const ServiceConfig& service : deployment.services) {
    const bool known = find(components, service.kind) != nullptr;
    if (!options.process.empty()) {
      if (!service.process.empty()) candidates.push_back(service.process);
      if (service.process != options.process) continue;
      if (!known) fail("this program knows no kind " + service.kind + "; start quoin-process");
      services.push_back(&service);
    } else if (known) {
      candidates.push_back(label(service));
      if (label(service) != options.service) continue;
      if (!service.process.empty()) {
        fail("service '" + options.service + "' runs in process '" + service.process +
             "'; start quoin-process with --process " + service.process);
      }
      services.push_back(&service);
    }
  }
  if (!services.empty()) return services;
  std::string kinds;
  for (const Component& component : components) {
    kinds += (kinds.empty() ? "" : " or ") + component.kind->name;
  }
  fail(options.process.empty()
           ? "no service '" + options.service + "' of kind " + kinds +
                 suggestion(options.service, candidates)
           : "no process '" + options.process + "'" + suggestion(options.process, candidates));
  return services;
}

// [s] Each pair of participants has to shake hands first, which takes ten of them that start at
// once on a busy machine many seconds.
double default_wait(const Deployment& deployment) { return deployment.security ? 30.0 : 10.0; }

using Clock = std::chrono::steady_clock;

// From SIGTERM to the end of the last service; whoever supervises the process kills it sooner.
constexpr std::chrono::seconds longest_end{20};
// That a service which is to stop may be late with a sign of life: it works on something that takes
// for ever, such as a file without an end.
constexpr std::chrono::milliseconds latest_sign_of_life{1500};
constexpr std::chrono::milliseconds look_period{100};

/// Runs services in threads of their own and ends them in the order of the deployment.
class Runner {
 public:
  Runner(StopSignal& signal, Process& process) : signal_(signal), process_(process) {}
  ~Runner() { process_.heartbeat.stop(); }  // before its services go
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  void add(const ServiceConfig& config, std::size_t observers, Component::Body body) {
    auto entry = std::make_unique<Entry>();
    entry->service = std::make_unique<Service>(process_, config, observers);
    entry->body = std::move(body);
    entry->level = process_.graph.level(config);
    entries_.push_back(std::move(entry));
  }

  int run() {
    process_.heartbeat.start();
    for (const auto& entry : entries_) {
      entry->thread = std::thread([this, entry = entry.get()] { work(*entry); });
    }
    signal_.on_request([this] { notify(); });
    wait();
    signal_.on_request(nullptr);
    int exit_code = exit_ok;
    for (const auto& entry : entries_) {
      entry->thread.join();
      if (exit_code == exit_ok) exit_code = entry->exit_code;
    }
    return exit_code;
  }

 private:
  struct Entry {
    std::unique_ptr<Service> service;
    Component::Body body;
    int level = 0;
    std::thread thread;
    // Under the mutex.
    Clock::time_point asked_to_stop = Clock::time_point::max();
    bool ended = false;
    bool finished = false;  // has no more to do, which counts for those who read it
    int exit_code = exit_ok;
  };

  void notify() {
    const std::lock_guard lock(mutex_);
    something_happened_ = true;
    changed_.notify_all();
  }

  /// A service that fails leaves the others at work.
  void work(Entry& entry) {
    Service& service = *entry.service;
    const LogName log_name(label(service.config));
    int exit_code = exit_failure;
    try {
      exit_code = entry.body(service);
    } catch (const std::exception& error) {
      spdlog::error("{}", failure_text(error));
      service.record.set_endpoint_report(nullptr);
      process_.heartbeat.finish(service.record, msg::ServiceState::STATE_FAILED, error.what());
    }
    const std::lock_guard lock(mutex_);
    entry.ended = true;
    entry.finished = entry.finished || service.finished;
    entry.exit_code = exit_code;
    something_happened_ = true;
    changed_.notify_all();
  }

  /// Until all have ended.
  void wait() {
    std::unique_lock lock(mutex_);
    while (true) {
      const std::vector<Entry*> to_stop = next_to_stop();
      if (std::ranges::all_of(entries_, &Entry::ended)) return;
      for (Entry* entry : to_stop) {
        entry->asked_to_stop = std::min(entry->asked_to_stop, Clock::now());
      }
      lock.unlock();
      for (Entry* entry : to_stop) entry->service->stop.request();
      lock.lock();
      const bool ending = signal_.requested();
      if (ending && give_up_ == Clock::time_point::max()) give_up_ = Clock::now() + longest_end;
      if (ending && (Clock::now() >= give_up_ || one_hangs())) abandon();
      changed_.wait_until(lock, ending ? Clock::now() + look_period : Clock::time_point::max(),
                          [this] { return something_happened_; });
      something_happened_ = false;
    }
  }

  [[nodiscard]] bool one_hangs() const {
    const auto now = Clock::now();
    return std::ranges::any_of(entries_, [&](const auto& entry) {
      return !entry->ended && now - latest_sign_of_life > entry->asked_to_stop &&
             !entry->service->pulse.alive(now, latest_sign_of_life);
    });
  }

  /// Ends the process with services that cannot be ended.
  [[noreturn]] void abandon() const {
    for (const auto& entry : entries_) {
      if (entry->ended) continue;
      spdlog::error("service '{}' does not end; leaving it as it is",
                    label(entry->service->config));
    }
    std::_Exit(exit_failure);
  }

  /// When the process is to stop those that no running one comes before; else those of which all
  /// inputs are here and have finished.
  std::vector<Entry*> next_to_stop() {
    std::vector<Entry*> next;
    int lowest = std::numeric_limits<int>::max();
    for (const auto& entry : entries_) {
      if (!entry->ended) lowest = std::min(lowest, entry->level);
    }
    if (signal_.requested() && lowest != std::numeric_limits<int>::max()) {
      process_.heartbeat.stopping();
    }
    for (const auto& entry : entries_) {
      if (entry->ended) continue;
      const bool stops = signal_.requested() && entry->level == lowest;
      if (!stops && !inputs_have_finished(*entry)) continue;
      entry->finished = !signal_.requested();
      next.push_back(entry.get());
    }
    return next;
  }

  [[nodiscard]] bool inputs_have_finished(const Entry& entry) const {
    const auto inputs = process_.graph.inputs_of(entry.service->config);
    return !inputs.empty() && std::ranges::all_of(inputs, [&](const Connection& input) {
      return std::ranges::any_of(entries_, [&](const auto& other) {
        return &other->service->config == input.writer && other->ended && other->finished;
      });
    });
  }

  StopSignal& signal_;
  Process& process_;
  std::vector<std::unique_ptr<Entry>> entries_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool something_happened_ = false;
  Clock::time_point give_up_ = Clock::time_point::max();
};

int run(const Options& options, const std::vector<Component>& components) {
  StopSignal signal;
  // Nothing is there yet that has an end of its own, and to open an input may take for ever.
  signal.on_request([] { std::_Exit(exit_ok); });
  KindList kinds{{}, false};
  for (const Component& component : components) kinds.kinds.push_back(component.kind);
  const Deployment deployment =
      parse_deployment(read_deployment(options.deployment), options.deployment_name, kinds);
  const auto services = services_to_run(deployment, options, components);
  std::vector<Component::Body> bodies;
  for (const ServiceConfig* service : services) {
    try {
      bodies.push_back(find(components, service->kind)->open(deployment, *service));
    } catch (const ParameterError& error) {
      throw DeploymentError({options.deployment_name + ": service '" + label(*service) +
                             "': parameter '" + error.parameter() + "': " + error.what()});
    }
  }
  auto observers = parse_observers(options.observers);
  const double wait = options.longest_wait.value_or(default_wait(deployment));
  std::string user_data;
  for (const Companion::Functions& each : companions()) user_data += each.user_data(deployment);
  Process process(deployment, options.name(), services, std::chrono::duration<double>(wait),
                  options.held, std::move(user_data));
  std::vector<std::shared_ptr<void>> opened_companions;
  for (const Companion::Functions& each : companions()) {
    opened_companions.push_back(each.open(process.participant, deployment, services));
  }
  Runner runner(signal, process);
  for (std::size_t i = 0; i < services.size(); ++i) {
    const std::string name = label(*services[i]);
    runner.add(*services[i], observers[name] + observers[""], std::move(bodies[i]));
  }
  return runner.run();
}

}  // namespace

Registration::Registration(Component component) { registry().push_back(std::move(component)); }

const std::vector<Component>& registered_components() { return registry(); }

Companion::Companion(Functions functions) { companions().push_back(std::move(functions)); }

int run_process(int argc, char** argv, const std::vector<Component>& components) {
  report_uncaught_exceptions();
  const bool one_kind = components.size() == 1;
  CLI::App app{(one_kind ? "Quoin service of kind " + components.front().kind->name
                         : "Quoin services in one process") +
               ", as described in a deployment file"};
  Options options;
  add_options(app, options);
  try {
    app.parse(argc, argv);
    if (options.name().empty()) throw CLI::RequiredError("--service or --process");
    (void)parse_observers(options.observers);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_configuration;
  }
  start_log(options.name());
  if (options.deployment_name.empty()) options.deployment_name = options.deployment;
  try {
    return run(options, components);
  } catch (const DeploymentError& error) {
    for (const std::string& message : error.messages()) spdlog::error("{}", message);
    return exit_configuration;
  } catch (const std::exception& error) {
    spdlog::error("{}", failure_text(error));
    return exit_failure;
  }
}

}  // namespace quoin::runtime
