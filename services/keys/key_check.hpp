// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin {

/// What keeps `identity` from taking part in the deployment with the files that are there, each
/// with the way out; empty when nothing does, and without security.
[[nodiscard]] std::vector<std::string> key_problems(const Deployment& deployment,
                                                    const std::string& identity);

/// Throws DeploymentError with the problems of all `identities`.
void require_keys(const Deployment& deployment, const std::vector<std::string>& identities);

/// Common name of the authority. Throws std::runtime_error.
[[nodiscard]] std::string authority_name(const std::filesystem::path& directory);

/// When the certificate of an identity ends. Throws std::runtime_error.
[[nodiscard]] std::chrono::system_clock::time_point certificate_end(
    const std::filesystem::path& directory, const std::string& identity);

}  // namespace quoin
