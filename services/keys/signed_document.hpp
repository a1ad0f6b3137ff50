// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "services/keys/certificate.hpp"

namespace quoin {

/// `text` and the authority's signature of it as an S/MIME message of two parts, the form in which
/// DDS Security wants governance and permissions.
[[nodiscard]] std::string sign_document(const std::string& text, const KeyPair& authority);

/// The text of such a message, with line ends as they were. Throws std::runtime_error when the
/// authority has not signed it.
[[nodiscard]] std::string verify_document(const std::string& document, X509* authority);

}  // namespace quoin
