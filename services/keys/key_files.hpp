// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin {

/// "FILE: reason" of an errno.
[[nodiscard]] std::runtime_error file_error(const std::filesystem::path& file, int error);

/// Throws file_error. Files of more than a megabyte are refused.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Identities that are no services. No service can be called so: its name has no hyphen.
inline constexpr std::string_view operator_identity = "quoin-operator";  ///< commands that change
inline constexpr std::string_view observer_identity = "quoin-observer";  ///< commands that look

/// Secret of the certificate authority: who has it can make identities. Stays where it was made.
[[nodiscard]] std::filesystem::path authority_key(const std::filesystem::path& directory);

/// What every host has.
struct TrustFiles {
  std::filesystem::path authority;   ///< certificate of the authority
  std::filesystem::path revoked;     ///< list of revoked certificates, signed
  std::filesystem::path governance;  ///< what is protected and how, signed
};
[[nodiscard]] TrustFiles trust_files(const std::filesystem::path& directory, bool encrypt);

/// What only the host of an identity has.
struct IdentityFiles {
  std::filesystem::path certificate;
  std::filesystem::path private_key;
  std::filesystem::path permissions;  ///< topics it may write and read, signed
};
[[nodiscard]] IdentityFiles identity_files(const std::filesystem::path& directory,
                                           std::string_view identity);
/// Folder of those three.
[[nodiscard]] std::filesystem::path identity_folder(const std::filesystem::path& directory,
                                                    std::string_view identity);

/// Identities that the deployment needs: its processes by name, and the roles of the commands.
[[nodiscard]] std::vector<std::string> identities_of(const Deployment& deployment);

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
