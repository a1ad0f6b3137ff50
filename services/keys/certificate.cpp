// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/certificate.hpp"

#include <ctime>
#include <initializer_list>
#include <openssl/ec.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <utility>

namespace quoin {

std::runtime_error openssl_error(const std::string& what) {
  std::string text = "cannot " + what;
  if (const unsigned long code = ERR_peek_last_error(); code != 0) {
    const char* reason = ERR_reason_error_string(code);
    if (reason != nullptr) text += std::string(": ") + reason;
  }
  ERR_clear_error();
  return std::runtime_error(text);
}

OpensslBio memory_bio(const std::string& text) {
  OpensslBio bio(BIO_new(BIO_s_mem()));
  require(bio != nullptr, "allocate memory");
  const int size = static_cast<int>(text.size());
  require(size == 0 || BIO_write(bio.get(), text.data(), size) == size, "allocate memory");
  return bio;
}

std::string text_of(BIO* bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio, &data);
  return size > 0 ? std::string(data, static_cast<std::size_t>(size)) : std::string();
}

namespace {

using Clock = std::chrono::system_clock;
using Extensions = std::initializer_list<std::pair<int, const char*>>;

constexpr int serial_bits = 127;  // random, so that no count needs to be kept

void set_name(X509_NAME* subject, const std::string& name) {
  // Not by OpenSSL's table of lengths: a label may be longer than its 64 characters.
  require(X509_NAME_add_entry_by_NID(subject, NID_commonName, V_ASN1_UTF8STRING,
                                     reinterpret_cast<const unsigned char*>(name.data()),
                                     static_cast<int>(name.size()), -1, 0) == 1,
          "write the name of a certificate");
}

void set_serial(X509* certificate) {
  const OpensslBignum number(BN_new());
  require(number != nullptr &&
              BN_rand(number.get(), serial_bits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
              BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate)) != nullptr,
          "make a serial number");
}

KeyPair make_pair(const std::string& name, const Validity& validity, const KeyPair* issuer,
                  Extensions extensions) {
  KeyPair pair{OpensslKey(EVP_EC_gen("P-256")), OpensslCertificate(X509_new())};
  require(pair.key != nullptr, "make a private key");
  X509* certificate = pair.certificate.get();
  require(certificate != nullptr && X509_set_version(certificate, X509_VERSION_3) == 1,
          "make a certificate");
  set_serial(certificate);
  set_name(X509_get_subject_name(certificate), name);
  X509* signer = issuer == nullptr ? certificate : issuer->certificate.get();
  require(X509_set_issuer_name(certificate, X509_get_subject_name(signer)) == 1 &&
              X509_set_pubkey(certificate, pair.key.get()) == 1 &&
              ASN1_TIME_set(X509_getm_notBefore(certificate), Clock::to_time_t(validity.from)) !=
                  nullptr &&
              ASN1_TIME_set(X509_getm_notAfter(certificate), Clock::to_time_t(validity.until)) !=
                  nullptr,
          "fill in a certificate");
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, signer, certificate, nullptr, nullptr, 0);
  for (const auto& [kind, value] : extensions) {
    const OpensslExtension extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value));
    require(extension != nullptr && X509_add_ext(certificate, extension.get(), -1) == 1,
            "add an extension to a certificate");
  }
  EVP_PKEY* key = issuer == nullptr ? pair.key.get() : issuer->key.get();
  require(X509_sign(certificate, key, EVP_sha256()) > 0, "sign a certificate");
  return pair;
}

void sign_list(X509_CRL* list, const KeyPair& authority) {
  // No time of a next update: a list without one does not go out of date.
  const OpensslTime now(ASN1_TIME_set(nullptr, Clock::to_time_t(valid_for_days(0).from)));
  require(now != nullptr && X509_CRL_set1_lastUpdate(list, now.get()) == 1 &&
              X509_CRL_sort(list) == 1 &&
              X509_CRL_sign(list, authority.key.get(), EVP_sha256()) > 0,
          "sign the list of revoked certificates");
}

}  // namespace

Validity valid_for_days(int days) {
  const auto now = Clock::now();
  return {now - std::chrono::hours(24), now + std::chrono::hours(24 * days)};
}

KeyPair make_authority(const std::string& name, const Validity& validity) {
  // It signs documents, too, for which S/MIME asks for digitalSignature.
  return make_pair(name, validity, nullptr,
                   {{NID_basic_constraints, "critical,CA:TRUE,pathlen:0"},
                    {NID_key_usage, "critical,digitalSignature,keyCertSign,cRLSign"},
                    {NID_subject_key_identifier, "hash"}});
}

KeyPair make_identity(const KeyPair& authority, const std::string& name, const Validity& validity) {
  return make_pair(name, validity, &authority,
                   {{NID_basic_constraints, "critical,CA:FALSE"},
                    {NID_key_usage, "critical,digitalSignature,keyAgreement"},
                    {NID_subject_key_identifier, "hash"},
                    {NID_authority_key_identifier, "keyid"}});
}

OpensslRevocationList make_revocation_list(const KeyPair& authority) {
  OpensslRevocationList list(X509_CRL_new());
  require(list != nullptr && X509_CRL_set_version(list.get(), X509_CRL_VERSION_2) == 1 &&
              X509_CRL_set_issuer_name(list.get(),
                                       X509_get_subject_name(authority.certificate.get())) == 1,
          "make a list of revoked certificates");
  sign_list(list.get(), authority);
  return list;
}

void revoke(OpensslRevocationList& list, const KeyPair& authority, X509* certificate) {
  X509_REVOKED* known = nullptr;
  if (X509_CRL_get0_by_cert(list.get(), &known, certificate) == 1) return;
  OpensslRevoked entry(X509_REVOKED_new());
  const OpensslTime now(ASN1_TIME_set(nullptr, Clock::to_time_t(Clock::now())));
  require(entry != nullptr && now != nullptr &&
              X509_REVOKED_set_serialNumber(entry.get(), X509_get_serialNumber(certificate)) == 1 &&
              X509_REVOKED_set_revocationDate(entry.get(), now.get()) == 1 &&
              X509_CRL_add0_revoked(list.get(), entry.get()) == 1,
          "revoke a certificate");
  (void)entry.release();  // the list has it
  sign_list(list.get(), authority);
}

std::string private_key_text(EVP_PKEY* key) {
  const OpensslBio bio = memory_bio();
  require(PEM_write_bio_PKCS8PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
          "write a private key");
  return text_of(bio.get());
}

std::string certificate_text(X509* certificate) {
  const OpensslBio bio = memory_bio();
  require(PEM_write_bio_X509(bio.get(), certificate) == 1, "write a certificate");
  return text_of(bio.get());
}

std::string revocation_list_text(X509_CRL* list) {
  const OpensslBio bio = memory_bio();
  require(PEM_write_bio_X509_CRL(bio.get(), list) == 1, "write the list of revoked certificates");
  return text_of(bio.get());
}

OpensslKey parse_private_key(const std::string& text) {
  // A password would be asked for on the terminal; these keys have none.
  const auto no_password = [](char*, int, int, void*) { return -1; };
  const OpensslBio bio = memory_bio(text);
  OpensslKey key(PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, nullptr));
  require(key != nullptr, "read it as a private key");
  return key;
}

OpensslCertificate parse_certificate(const std::string& text) {
  const OpensslBio bio = memory_bio(text);
  OpensslCertificate certificate(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
  require(certificate != nullptr, "read it as a certificate");
  return certificate;
}

OpensslRevocationList parse_revocation_list(const std::string& text) {
  const OpensslBio bio = memory_bio(text);
  OpensslRevocationList list(PEM_read_bio_X509_CRL(bio.get(), nullptr, nullptr, nullptr));
  require(list != nullptr, "read it as a list of revoked certificates");
  return list;
}

std::string common_name(X509* certificate) {
  X509_NAME* subject = X509_get_subject_name(certificate);
  const int index = X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
  if (index < 0) return "";
  const ASN1_STRING* text = X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, index));
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
          static_cast<std::size_t>(ASN1_STRING_length(text))};
}

Clock::time_point valid_until(X509* certificate) {
  std::tm time{};
  require(ASN1_TIME_to_tm(X509_get0_notAfter(certificate), &time) == 1, "read a time");
  return Clock::from_time_t(::timegm(&time));
}

std::string objection(X509* certificate, X509* authority, X509_CRL* revoked) {
  const std::unique_ptr<X509_STORE, OpensslDeleter<X509_STORE_free>> store(X509_STORE_new());
  const std::unique_ptr<X509_STORE_CTX, OpensslDeleter<X509_STORE_CTX_free>> context(
      X509_STORE_CTX_new());
  require(store != nullptr && context != nullptr &&
              X509_STORE_add_cert(store.get(), authority) == 1 &&
              X509_STORE_add_crl(store.get(), revoked) == 1 &&
              X509_STORE_set_flags(store.get(), X509_V_FLAG_CRL_CHECK) == 1 &&
              X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr) == 1,
          "check a certificate");
  if (X509_verify_cert(context.get()) == 1) return "";
  return X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()));
}

}  // namespace quoin
