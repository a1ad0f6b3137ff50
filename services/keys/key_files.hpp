// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin {

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

/// Identities that the deployment needs: its services by label, and the roles of the commands.
[[nodiscard]] std::vector<std::string> identities_of(const Deployment& deployment);

}  // namespace quoin
