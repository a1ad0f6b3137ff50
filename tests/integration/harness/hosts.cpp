// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/harness/hosts.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>

#include "services/runtime/dds/interfaces.hpp"
#include "tests/integration/harness/lossy_wire.hpp"
#include "tests/integration/harness/process.hpp"

namespace quoin::tests {

namespace {

using sensor_bridge::FileDescriptor;

/// Exit code of a program of this machine, which runs where this thread stands.
int exit_code_of(std::vector<std::string> arguments, bool quiet = false) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (quiet) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  }
  pid_t process = 0;
  const int error = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || waitpid(process, &status, 0) != process) return 127;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

/// `ip` or `tc` with the words of `command`.
void run(const std::string& command) {
  std::istringstream words(command);
  std::vector<std::string> arguments;
  for (std::string word; words >> word;) arguments.push_back(word);
  if (exit_code_of(arguments) != 0) throw std::runtime_error("failed: " + command);
}

FileDescriptor present_namespace() {
  FileDescriptor made(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC));
  if (!made) throw std::system_error(errno, std::generic_category(), "/proc/thread-self/ns/net");
  return made;
}

void step_into(const FileDescriptor& name_space) {
  if (setns(name_space.get(), CLONE_NEWNET) != 0) {
    throw std::system_error(errno, std::generic_category(), "setns");
  }
}

/// A new namespace, in which this thread stands from then on.
FileDescriptor make_namespace() {
  if (unshare(CLONE_NEWNET) != 0) {
    throw std::system_error(errno, std::generic_category(), "unshare");
  }
  // Nothing is sent but what we send.
  for (const char* which : {"all", "default"}) {
    std::ofstream("/proc/sys/net/ipv6/conf/" + std::string(which) + "/disable_ipv6") << 1;
  }
  run("ip link set lo up");
  return present_namespace();
}

std::string path_of(const FileDescriptor& name_space) {
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(name_space.get());
}

bool all_have_a_link() {
  const auto addresses = runtime::host_addresses();
  return std::all_of(addresses.begin(), addresses.end(),
                     [](const auto& address) { return address.running; });
}

bool kernel_impairs() {
  return exit_code_of({"tc", "qdisc", "add", "dev", "lo", "root", "netem"}, true) == 0;
}

}  // namespace

std::optional<std::string> Hosts::refusal(bool lossy) {
  int error = 0;
  std::thread([&] { error = unshare(CLONE_NEWNET) == 0 ? 0 : errno; }).join();
  if (error != 0) {
    return "this user may not make network namespaces (" + std::string(std::strerror(error)) +
           "); run as root, in a container with --privileged";
  }
  if (exit_code_of({"ip", "-V"}, true) != 0) return "there is no ip; install iproute2";
  if (lossy && access("/dev/net/tun", R_OK | W_OK) != 0) {
    bool impairs = false;
    std::thread([&] { impairs = unshare(CLONE_NEWNET) == 0 && kernel_impairs(); }).join();
    if (!impairs) return "this kernel has neither netem nor /dev/net/tun to make links that lose";
  }
  return std::nullopt;
}

Hosts::Hosts(std::vector<std::string> names, const std::string& lossy)
    : outside_(present_namespace()), switch_(make_namespace()), lossy_(lossy) {
  // Switches that snoop would send frames of their own.
  run("ip link add name switch type bridge mcast_snooping 0");
  run("ip link add name aux_switch type bridge mcast_snooping 0");
  run("ip link set switch up");
  run("ip link set aux_switch up");
  for (const std::string& name : names) hosts_[name] = make_namespace();
  home_ = names.back();
  for (std::size_t i = 0; i < names.size(); ++i) connect(names[i], i);
  // The kernel takes note of a carrier a little later.
  for (const std::string& name : names) {
    if (!eventually([&] { return on(name, &all_have_a_link); })) {
      throw std::runtime_error("no link on " + name);
    }
  }
}

Hosts::~Hosts() {
  wire_.reset();
  [[maybe_unused]] const int left = setns(outside_.get(), CLONE_NEWNET);
}

void Hosts::connect(const std::string& host, std::size_t number) {
  const std::string peer = " netns " + path_of(hosts_.at(host));
  step_into(switch_);
  const bool tap = host == lossy_ && !kernel_impairs();
  if (tap) {
    FileDescriptor here = make_tap("to_" + host);
    wire_ = std::make_unique<LossyWire>(std::move(here), on(host, [] { return make_tap("eth0"); }));
    step_into(switch_);
  } else {
    run("ip link add to_" + host + " type veth peer name eth0" + peer);
  }
  run("ip link add aux_" + host + " type veth peer name aux0" + peer);
  run("ip link set to_" + host + " master switch up");
  run("ip link set aux_" + host + " master aux_switch up");
  step_into(hosts_.at(host));
  const std::string last = std::to_string(number + 1);
  run("ip addr add 10.77.0." + last + "/24 dev eth0");
  run("ip addr add 10.78.0." + last + "/24 dev aux0");
  run("ip link set eth0 up");
  run("ip link set aux0 up");
  step_into(hosts_.at(home_));
}

void Hosts::cut(const std::string& host) const {
  step_into(switch_);
  run("ip link set to_" + host + " down");
  step_into(hosts_.at(home_));
}

void Hosts::mend(const std::string& host) const {
  step_into(switch_);
  run("ip link set to_" + host + " up");
  step_into(hosts_.at(home_));
}

std::uint64_t Hosts::frames(const std::string& host, const std::string& interface) const {
  return on(host, [&]() -> std::uint64_t {
    std::ifstream file("/proc/thread-self/net/dev");
    for (std::string line; std::getline(file, line);) {
      const std::size_t colon = line.find(':');
      if (colon == std::string::npos) continue;
      if (line.substr(line.find_first_not_of(' '), interface.size() + 1) != interface + ":")
        continue;
      // Eight numbers of what was received, the second of which is frames; likewise for sent.
      std::istringstream fields(line.substr(colon + 1));
      std::vector<std::uint64_t> numbers;
      for (std::uint64_t number = 0; fields >> number;) numbers.push_back(number);
      return numbers.at(1) + numbers.at(9);
    }
    throw std::runtime_error("no interface " + interface + " on " + host);
  });
}

std::uint64_t Hosts::fragments(const std::string& host) const {
  return on(host, [&]() -> std::uint64_t {
    // The first line that begins with "Ip:" has names, the second the numbers.
    std::ifstream file("/proc/thread-self/net/snmp");
    std::string names, numbers;
    std::getline(file, names);
    std::getline(file, numbers);
    std::istringstream name_fields(names), number_fields(numbers);
    for (std::string name, number; name_fields >> name && number_fields >> number;) {
      if (name == "FragCreates") return std::stoull(number);
    }
    throw std::runtime_error("no count of fragments on " + host);
  });
}

void Hosts::impair(double loss, std::chrono::milliseconds delay) const {
  if (wire_) {
    wire_->impair(loss, delay);
    return;
  }
  const std::string how = " root netem limit 10000 loss " + std::to_string(100.0 * loss) +
                          "% delay " + std::to_string(delay.count()) + "ms";
  on(lossy_, [&] { run("tc qdisc replace dev eth0" + how); });
  step_into(switch_);
  run("tc qdisc replace dev to_" + lossy_ + how);
  step_into(hosts_.at(home_));
}

Hosts::Visit::Visit(const Hosts& hosts, const std::string& host) : hosts_(hosts) {
  step_into(hosts_.hosts_.at(host));
}

Hosts::Visit::~Visit() {
  [[maybe_unused]] const int back = setns(hosts_.hosts_.at(hosts_.home_).get(), CLONE_NEWNET);
}

}  // namespace quoin::tests
