// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/orchestration/host.hpp"

#include <algorithm>
#include <array>
#include <unistd.h>
#include <vector>

#include "core/parameters/parameter.hpp"

namespace quoin::deploy {

namespace {

std::string machine_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

std::string host_to_run(const Deployment& deployment, const std::string& asked) {
  const std::vector<std::string> hosts = hosts_of(deployment);
  const std::string file = deployment.file.string();
  if (hosts.empty()) {
    if (asked.empty()) return "";
    throw DeploymentError({file + ": names no hosts; leave --host out, or give each service one"});
  }
  const std::string host = asked.empty() ? machine_name() : asked;
  if (std::find(hosts.begin(), hosts.end(), host) != hosts.end()) return host;
  if (!asked.empty()) {
    throw DeploymentError({file + ": no host '" + asked + "'" + suggestion(asked, hosts)});
  }
  std::string names;
  for (const std::string& name : hosts) names += (names.empty() ? "" : ", ") + name;
  throw DeploymentError({file + ": is for the hosts " + names + ", and this machine is called '" +
                         host + "'; say which share to start with --host NAME"});
}

std::vector<std::string> hosts_to_change(const Deployment& deployment, const std::string& asked) {
  const std::vector<std::string> hosts = hosts_of(deployment);
  if (asked.empty() && !hosts.empty()) return hosts;
  return {host_to_run(deployment, asked)};
}

}  // namespace quoin::deploy
