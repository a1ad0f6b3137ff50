// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "deploy/keys/key_directory.hpp"
#include "deploy/keys/key_files.hpp"
#include "tests/integration/harness/deployment.hpp"

namespace quoin::tests {

/// Keys that are far from their end, of which services would warn.
constexpr int days_of_keys = 100;

/// An identity that may do what `rules` say.
inline void add_keys(const std::filesystem::path& keys, const std::string& identity,
                     const std::vector<deploy::TopicRule>& rules,
                     const deploy::Validity& validity = deploy::valid_for_days(days_of_keys)) {
  const deploy::KeyPair authority = deploy::load_authority(keys);
  deploy::add_identity(keys, authority, identity, validity, false);
  deploy::write_permissions(keys, authority, identity, deploy::valid_for_days(days_of_keys), rules);
}

/// All keys of a deployment that has security.
inline void make_keys(const TestDeployment& deployment) {
  const std::filesystem::path& keys = deployment.deployment().security->directory;
  deploy::make_key_directory(keys, days_of_keys, false);
  for (const std::string& identity : deploy::identities_of(deployment.deployment())) {
    add_keys(keys, identity, {deploy::rule_of(deployment.deployment(), identity)});
  }
}

}  // namespace quoin::tests
