// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "services/keys/key_directory.hpp"
#include "services/keys/key_files.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin::tests {

/// Keys that are far from their end, of which services would warn.
constexpr int days_of_keys = 100;

/// An identity that may do what `rules` say.
inline void add_keys(const std::filesystem::path& keys, const std::string& identity,
                     const std::vector<TopicRule>& rules,
                     const Validity& validity = valid_for_days(days_of_keys)) {
  const KeyPair authority = load_authority(keys);
  add_identity(keys, authority, identity, validity, false);
  write_permissions(keys, authority, identity, valid_for_days(days_of_keys), rules);
}

/// All keys of a deployment that has security.
inline void make_keys(const TestDeployment& deployment) {
  const std::filesystem::path& keys = deployment.deployment().security->directory;
  make_key_directory(keys, days_of_keys, false);
  for (const std::string& identity : identities_of(deployment.deployment())) {
    add_keys(keys, identity, {rule_of(deployment.deployment(), identity)});
  }
}

}  // namespace quoin::tests
