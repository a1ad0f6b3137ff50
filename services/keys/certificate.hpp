// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "services/keys/openssl.hpp"

namespace quoin {

/// When something signed counts.
struct Validity {
  std::chrono::system_clock::time_point from;
  std::chrono::system_clock::time_point until;
};

/// From a day ago, since clocks differ between hosts, for `days`.
[[nodiscard]] Validity valid_for_days(int days);

/// A certificate with the private key that belongs to it.
struct KeyPair {
  OpensslKey key;
  OpensslCertificate certificate;
};

/// A new certificate authority on the elliptic curve P-256, signed by itself. `name` is its common
/// name; participants tell authorities apart by it. Throws std::runtime_error, as all of these do.
[[nodiscard]] KeyPair make_authority(const std::string& name, const Validity& validity);

/// A new identity with the common name `name`, signed by the authority.
[[nodiscard]] KeyPair make_identity(const KeyPair& authority, const std::string& name,
                                    const Validity& validity);

/// A list of revoked certificates without an entry.
[[nodiscard]] OpensslRevocationList make_revocation_list(const KeyPair& authority);
/// Adds the certificate, unless it is in the list, and signs the list anew.
void revoke(OpensslRevocationList& list, const KeyPair& authority, X509* certificate);

[[nodiscard]] std::string private_key_text(EVP_PKEY* key);  ///< PEM, PKCS#8, as all of these
[[nodiscard]] std::string certificate_text(X509* certificate);
[[nodiscard]] std::string revocation_list_text(X509_CRL* list);

[[nodiscard]] OpensslKey parse_private_key(const std::string& text);
[[nodiscard]] OpensslCertificate parse_certificate(const std::string& text);
[[nodiscard]] OpensslRevocationList parse_revocation_list(const std::string& text);

[[nodiscard]] std::string common_name(X509* certificate);
[[nodiscard]] std::chrono::system_clock::time_point valid_until(X509* certificate);
/// Why participants of the authority do not accept the certificate now; "" when they do.
[[nodiscard]] std::string objection(X509* certificate, X509* authority, X509_CRL* revoked);

}  // namespace quoin
