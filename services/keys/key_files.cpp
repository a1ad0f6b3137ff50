// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/key_files.hpp"

namespace quoin {

std::filesystem::path authority_key(const std::filesystem::path& directory) {
  return directory / "ca" / "key.pem";
}

TrustFiles trust_files(const std::filesystem::path& directory, bool encrypt) {
  const std::filesystem::path trust = directory / "trust";
  return {trust / "authority.pem", trust / "revoked.pem",
          trust / (encrypt ? "governance_encrypt.smime" : "governance_sign.smime")};
}

std::filesystem::path identity_folder(const std::filesystem::path& directory,
                                      std::string_view identity) {
  return directory / "identities" / identity;
}

IdentityFiles identity_files(const std::filesystem::path& directory, std::string_view identity) {
  const std::filesystem::path folder = identity_folder(directory, identity);
  return {folder / "certificate.pem", folder / "key.pem", folder / "permissions.smime"};
}

std::vector<std::string> identities_of(const Deployment& deployment) {
  std::vector<std::string> identities;
  for (const ServiceConfig& service : deployment.services) identities.push_back(label(service));
  identities.emplace_back(operator_identity);
  identities.emplace_back(observer_identity);
  return identities;
}

}  // namespace quoin
