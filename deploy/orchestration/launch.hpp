// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "deploy/orchestration/supervisor.hpp"
#include "services/deployment/deployment.hpp"

namespace quoin::deploy {

/// The folder of this executable, where the programs of the services are.
[[nodiscard]] std::filesystem::path program_folder();

/// Name of the process that runs the discovery servers of this host; no service is called so.
inline constexpr const char* discovery_process = "discovery-servers";

/// Whether a discovery server of the deployment is on this host. Throws DeploymentError when the
/// host has none of the deployment's interfaces.
[[nodiscard]] bool serves_discovery(const Deployment& deployment);

/// How to start the services of `deployment` that run on `host` (see host_to_run), and the
/// discovery servers that have one of this host's addresses. `observers` says how many readers
/// that are not in the deployment a service has to wait for, so that not even its first result is
/// missed. The services read `copy` of the deployment file when there is one. Throws
/// std::runtime_error when a program is not there, DeploymentError when a key is not.
[[nodiscard]] std::vector<ProcessPlan> process_plans(
    const Deployment& deployment, const std::string& host,
    const std::function<int(const ServiceConfig&)>& observers,
    const std::filesystem::path& copy = {});

}  // namespace quoin::deploy
