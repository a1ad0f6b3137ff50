// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

#include "services/deployment/deployment.hpp"

namespace quoin {

constexpr mode_t mode_private = 0600;  ///< for the owner alone
constexpr mode_t mode_public = 0644;

/// Makes the folder and those above it, for the owner alone, unless they are there.
void make_private_folder(const std::filesystem::path& folder);

/// Writes the file in one step: a reader sees all of the old or all of the new. Without `replace` a
/// file that is there is an error. Throws std::runtime_error.
void write_file(const std::filesystem::path& file, const std::string& text, mode_t mode,
                bool replace);

/// Throws std::runtime_error "FILE: reason". Files of more than a megabyte are refused.
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

/// Identities that the deployment needs: its services by label, and the roles of the commands.
[[nodiscard]] std::vector<std::string> identities_of(const Deployment& deployment);

}  // namespace quoin
