// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "services/deployment/deployment.hpp"
#include "services/keys/certificate.hpp"

namespace quoin {

/// The governance document of DDS Security 1.1 for every domain: nobody joins, reads or writes
/// without permission, and messages are encrypted, or signed only.
[[nodiscard]] std::string governance_text(bool encrypt);

/// Topics of one domain that an identity may write and read; * stands for any characters.
struct TopicRule {
  int domain = 0;
  std::vector<std::string> writes;
  std::vector<std::string> reads;

  friend bool operator==(const TopicRule&, const TopicRule&) = default;
};

/// What `identity` may do in the deployment: a process writes the outputs of its services,
/// heartbeats and replies, and reads their inputs and requests; the operator writes requests and
/// reads everything; the observer reads results and heartbeats. Throws std::out_of_range when the
/// deployment has no such process.
[[nodiscard]] TopicRule rule_of(const Deployment& deployment, const std::string& identity);

/// The permissions document of DDS Security 1.1; everything else is denied.
[[nodiscard]] std::string permissions_text(const std::string& identity, const Validity& validity,
                                           const std::vector<TopicRule>& rules);

/// A point in time as it stands in the document (UTC).
[[nodiscard]] std::string permissions_time(std::chrono::system_clock::time_point time);

/// `text` and the authority's signature of it as an S/MIME message of two parts, the form in which
/// DDS Security wants governance and permissions.
[[nodiscard]] std::string sign_document(const std::string& text, const KeyPair& authority);

/// The text of such a message, with line ends as they were. Throws std::runtime_error when the
/// authority has not signed it.
[[nodiscard]] std::string verify_document(const std::string& document, X509* authority);

}  // namespace quoin
