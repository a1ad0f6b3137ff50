// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/signed_document.hpp"

#include <algorithm>

namespace quoin {

std::string sign_document(const std::string& text, const KeyPair& authority) {
  // Signed while it is written, hence PKCS7_STREAM.
  constexpr int flags = PKCS7_DETACHED | PKCS7_TEXT | PKCS7_STREAM;
  const OpensslBio content = memory_bio(text);
  const OpensslBio document = memory_bio();
  const OpensslSigned signature(
      PKCS7_sign(authority.certificate.get(), authority.key.get(), nullptr, content.get(), flags));
  require(signature != nullptr &&
              SMIME_write_PKCS7(document.get(), signature.get(), content.get(), flags) == 1,
          "sign a document");
  return text_of(document.get());
}

std::string verify_document(const std::string& document, X509* authority) {
  const OpensslBio input = memory_bio(document);
  BIO* detached = nullptr;
  const OpensslSigned signature(SMIME_read_PKCS7(input.get(), &detached));
  const OpensslBio content(detached);
  require(signature != nullptr, "read it as a signed document");
  const std::unique_ptr<X509_STORE, OpensslDeleter<X509_STORE_free>> store(X509_STORE_new());
  require(store != nullptr && X509_STORE_add_cert(store.get(), authority) == 1,
          "check a signed document");
  const OpensslBio output = memory_bio();
  require(PKCS7_verify(signature.get(), nullptr, store.get(), content.get(), output.get(),
                       PKCS7_TEXT) == 1,
          "verify a signed document");
  std::string text = text_of(output.get());
  std::erase(text, '\r');
  return text;
}

}  // namespace quoin
