// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/keys/certificate.hpp"
#include "services/keys/documents.hpp"

namespace quoin {

// The folder that `security: {keys: DIRECTORY}` names. Folders get mode 0700, private keys 0600.
// Everything throws std::runtime_error that names the file and the way out.

/// Makes the authority, an empty list of revoked certificates and both governance documents.
/// `replace` allows to overwrite an authority; its identities are void then.
void make_key_directory(const std::filesystem::path& directory, int days, bool replace);

/// Signs the governance documents of this version, in place of those that are there.
void write_governance(const std::filesystem::path& directory, const KeyPair& authority);

/// The authority of the directory, with its private key.
[[nodiscard]] KeyPair load_authority(const std::filesystem::path& directory);

/// Makes private key and certificate of an identity. `replace` allows to overwrite them.
void add_identity(const std::filesystem::path& directory, const KeyPair& authority,
                  const std::string& identity, const Validity& validity, bool replace);

/// Signs what an identity may do, in place of what it might before.
void write_permissions(const std::filesystem::path& directory, const KeyPair& authority,
                       const std::string& identity, const Validity& validity,
                       const std::vector<TopicRule>& rules);

/// Adds the certificate of an identity to the list of revoked ones.
void revoke_identity(const std::filesystem::path& directory, const KeyPair& authority,
                     const std::string& identity);

/// Names of the identities in the directory, in order.
[[nodiscard]] std::vector<std::string> identities_in(const std::filesystem::path& directory);

/// Whether an identity can be called so: a service, with @strength where it has one, or a role.
[[nodiscard]] bool is_identity_name(const std::string& name);

}  // namespace quoin
