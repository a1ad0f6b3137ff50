// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/evp.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <stdexcept>
#include <string>
#include <string_view>

namespace quoin {

/// Frees what OpenSSL made with the function that it has for that.
template <auto Free>
struct OpensslDeleter {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};

using OpensslBio = std::unique_ptr<BIO, OpensslDeleter<BIO_free_all>>;
using OpensslBignum = std::unique_ptr<BIGNUM, OpensslDeleter<BN_free>>;
using OpensslKey = std::unique_ptr<EVP_PKEY, OpensslDeleter<EVP_PKEY_free>>;
using OpensslCertificate = std::unique_ptr<X509, OpensslDeleter<X509_free>>;
using OpensslExtension = std::unique_ptr<X509_EXTENSION, OpensslDeleter<X509_EXTENSION_free>>;
using OpensslRevocationList = std::unique_ptr<X509_CRL, OpensslDeleter<X509_CRL_free>>;
using OpensslRevoked = std::unique_ptr<X509_REVOKED, OpensslDeleter<X509_REVOKED_free>>;
using OpensslSigned = std::unique_ptr<PKCS7, OpensslDeleter<PKCS7_free>>;
using OpensslTime = std::unique_ptr<ASN1_TIME, OpensslDeleter<ASN1_TIME_free>>;

/// "cannot `what`: reason", with the reason of OpenSSL's error queue, which is emptied.
[[nodiscard]] std::runtime_error openssl_error(const std::string& what);

/// Throws openssl_error(what) unless `result` is what OpenSSL's functions return on success.
inline void require(bool result, const char* what) {
  if (!result) throw openssl_error(what);
}

/// A BIO on memory, filled with `text`.
[[nodiscard]] OpensslBio memory_bio(const std::string& text = "");
[[nodiscard]] std::string text_of(BIO* bio);

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
/// name; participants distinguish authorities by it. Throws std::runtime_error, as all of these do.
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
