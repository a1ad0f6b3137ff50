// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/key_directory.hpp"

#include <algorithm>
#include <cerrno>
#include <random>
#include <stdexcept>
#include <sys/stat.h>

#include "services/files/atomic_file.hpp"
#include "services/keys/documents.hpp"
#include "services/keys/key_files.hpp"

namespace quoin {

namespace {

constexpr mode_t mode_private = 0600;  // for the owner alone
constexpr mode_t mode_public = 0644;

/// Makes the folder and those above it, for the owner alone, unless they are there.
void make_private_folder(const std::filesystem::path& folder) {
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  make_private_folder(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) throw file_error(folder, errno);
}

/// A reader sees all of the old or all of the new. Without `replace` a file that is there is an
/// error.
void write_file(const std::filesystem::path& file, const std::string& text, mode_t mode,
                bool replace) {
  make_private_folder(file.parent_path());
  const int error = write_atomically(file, text, mode, replace);
  if (error == 0) return;
  if (error == EEXIST) {
    throw std::runtime_error(file.string() + " is there already; --force replaces it");
  }
  throw file_error(file, error);
}

/// `make` of the file's text; failures name the file.
template <class Function>
auto parse(const std::filesystem::path& file, Function make) {
  const std::string text = read_file(file);
  try {
    return make(text);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

/// Participants distinguish authorities by name.
std::string new_authority_name() {
  static constexpr char digits[] = "0123456789abcdef";
  std::random_device random;
  std::string name = "Quoin authority ";
  for (int i = 0; i < 16; ++i) name += digits[random() % 16];
  return name;
}

}  // namespace

bool is_identity_name(const std::string& name) {
  return !name.empty() && name.size() <= 80 &&
         name.find_first_not_of(
             "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@-") ==
             std::string::npos;
}

void make_key_directory(const std::filesystem::path& directory, int days, bool replace) {
  if (!replace && std::filesystem::exists(authority_key(directory))) {
    throw std::runtime_error(authority_key(directory).string() +
                             " is there already; --force replaces the authority, which voids all "
                             "identities that it has made");
  }
  const KeyPair authority = make_authority(new_authority_name(), valid_for_days(days));
  const TrustFiles trust = trust_files(directory, true);
  write_file(authority_key(directory), private_key_text(authority.key.get()), mode_private,
             replace);
  // What is left of an authority without its key is of no use.
  write_file(trust.authority, certificate_text(authority.certificate.get()), mode_public, true);
  write_file(trust.revoked, revocation_list_text(make_revocation_list(authority).get()),
             mode_public, true);
  write_governance(directory, authority);
}

void write_governance(const std::filesystem::path& directory, const KeyPair& authority) {
  for (const bool encrypt : {true, false}) {
    write_file(trust_files(directory, encrypt).governance,
               sign_document(governance_text(encrypt), authority), mode_public, true);
  }
}

KeyPair load_authority(const std::filesystem::path& directory) {
  const std::filesystem::path key = authority_key(directory);
  if (!std::filesystem::exists(key)) {
    throw std::runtime_error("there is no authority in " + directory.string() + " (" +
                             key.string() + "); quoin keys init " + directory.string() +
                             " makes one");
  }
  KeyPair authority{parse(key, parse_private_key),
                    parse(trust_files(directory, true).authority, parse_certificate)};
  if (X509_check_private_key(authority.certificate.get(), authority.key.get()) != 1) {
    throw openssl_error("use " + key.string() + " with " +
                        trust_files(directory, true).authority.string());
  }
  return authority;
}

void add_identity(const std::filesystem::path& directory, const KeyPair& authority,
                  const std::string& identity, const Validity& validity, bool replace) {
  if (!is_identity_name(identity)) {
    throw std::runtime_error("'" + identity + "' cannot be the name of an identity");
  }
  const IdentityFiles files = identity_files(directory, identity);
  const KeyPair pair = make_identity(authority, identity, validity);
  write_file(files.private_key, private_key_text(pair.key.get()), mode_private, replace);
  // Without its key a certificate is of no use.
  write_file(files.certificate, certificate_text(pair.certificate.get()), mode_public, true);
}

void write_permissions(const std::filesystem::path& directory, const KeyPair& authority,
                       const std::string& identity, const Validity& validity,
                       const std::vector<TopicRule>& rules) {
  write_file(identity_files(directory, identity).permissions,
             sign_document(permissions_text(identity, validity, rules), authority), mode_public,
             true);
}

void revoke_identity(const std::filesystem::path& directory, const KeyPair& authority,
                     const std::string& identity) {
  const TrustFiles trust = trust_files(directory, true);
  const OpensslCertificate certificate =
      parse(identity_files(directory, identity).certificate, parse_certificate);
  OpensslRevocationList list = parse(trust.revoked, parse_revocation_list);
  revoke(list, authority, certificate.get());
  write_file(trust.revoked, revocation_list_text(list.get()), mode_public, true);
}

std::vector<std::string> identities_in(const std::filesystem::path& directory) {
  std::vector<std::string> identities;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "identities", none)) {
    if (std::filesystem::exists(entry.path() / "certificate.pem")) {
      identities.push_back(entry.path().filename().string());
    }
  }
  std::sort(identities.begin(), identities.end());
  return identities;
}

}  // namespace quoin
