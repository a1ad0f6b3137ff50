// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "deploy/deployment/deployment.hpp"
#include "deploy/supervision/supervisor.hpp"

namespace quoin::deploy {

/// The folder of this executable, where the programs of the services are.
[[nodiscard]] std::filesystem::path program_folder();

/// How to start the services of `deployment`. `observers` tells how many readers that are not in
/// the deployment a service has to wait for, so that not even its first result is missed. The
/// processes read `copy` of the deployment file when there is one. Throws std::runtime_error when a
/// program is not there.
[[nodiscard]] std::vector<ProcessPlan> process_plans(
    const Deployment& deployment, const std::function<int(const ServiceConfig&)>& observers,
    const std::filesystem::path& copy = {});

}  // namespace quoin::deploy
