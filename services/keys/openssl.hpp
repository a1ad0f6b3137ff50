// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/evp.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>
#include <stdexcept>
#include <string>

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

}  // namespace quoin
