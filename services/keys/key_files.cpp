// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/key_files.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

namespace quoin {

namespace {

constexpr std::size_t largest_file = 1U << 20U;  // [byte]

std::runtime_error file_error(const std::filesystem::path& file, int error) {
  return std::runtime_error(file.string() + ": " + std::strerror(error));
}

/// Returns 0 or the error.
int write_all(int descriptor, const std::string& text, mode_t mode) {
  if (::fchmod(descriptor, mode) != 0) return errno;  // whatever the umask is
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(descriptor, text.data() + written, text.size() - written);
    if (count < 0 && errno != EINTR) return errno;
    if (count > 0) written += static_cast<std::size_t>(count);
  }
  return ::fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void make_private_folder(const std::filesystem::path& folder) {
  if (folder.empty() || std::filesystem::is_directory(folder)) return;
  make_private_folder(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) throw file_error(folder, errno);
}

void write_file(const std::filesystem::path& file, const std::string& text, mode_t mode,
                bool replace) {
  make_private_folder(file.parent_path());
  std::string unfinished = file.string() + ".XXXXXX";
  const int descriptor = ::mkostemp(unfinished.data(), O_CLOEXEC);
  if (descriptor < 0) throw file_error(file, errno);
  int error = write_all(descriptor, text, mode);
  ::close(descriptor);
  if (error == 0 && ::renameat2(AT_FDCWD, unfinished.c_str(), AT_FDCWD, file.c_str(),
                                replace ? 0 : RENAME_NOREPLACE) != 0) {
    error = errno;
  }
  if (error == 0) return;
  ::unlink(unfinished.c_str());
  if (error == EEXIST) {
    throw std::runtime_error(file.string() + " is there already; --force replaces it");
  }
  throw file_error(file, error);
}

std::string read_file(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw file_error(file, errno);
  std::string text;
  std::array<char, 4096> block{};
  ssize_t count = 0;
  while ((count = ::read(descriptor, block.data(), block.size())) != 0) {
    if (count < 0 && errno == EINTR) continue;
    const int error = count < 0 ? errno : text.size() > largest_file ? EFBIG : 0;
    if (error != 0) {
      ::close(descriptor);
      throw file_error(file, error);
    }
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

std::filesystem::path authority_key(const std::filesystem::path& directory) {
  return directory / "ca" / "key.pem";
}

TrustFiles trust_files(const std::filesystem::path& directory, bool encrypt) {
  const std::filesystem::path trust = directory / "trust";
  return {trust / "authority.pem", trust / "revoked.pem",
          trust / (encrypt ? "governance_encrypt.smime" : "governance_sign.smime")};
}

std::filesystem::path identity_folder(const std::filesystem::path& directory,
                                      std::string_view identity) {
  return directory / "identities" / identity;
}

IdentityFiles identity_files(const std::filesystem::path& directory, std::string_view identity) {
  const std::filesystem::path folder = identity_folder(directory, identity);
  return {folder / "certificate.pem", folder / "key.pem", folder / "permissions.smime"};
}

std::vector<std::string> identities_of(const Deployment& deployment) {
  std::vector<std::string> identities;
  for (const ServiceConfig& service : deployment.services) identities.push_back(label(service));
  identities.emplace_back(operator_identity);
  identities.emplace_back(observer_identity);
  return identities;
}

}  // namespace quoin
