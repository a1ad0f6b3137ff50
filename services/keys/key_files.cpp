// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/keys/key_files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <stdexcept>
#include <unistd.h>

#include "services/keys/certificate.hpp"
#include "services/keys/documents.hpp"

namespace quoin {

namespace {

constexpr std::size_t largest_file = 1U << 20U;  // [byte]

}  // namespace

std::runtime_error file_error(const std::filesystem::path& file, int error) {
  return std::runtime_error(file.string() + ": " + std::strerror(error));
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
  for (const ProcessConfig& process : processes_of(deployment)) {
    if (!process.services.front()->external()) identities.push_back(process.name);
  }
  identities.emplace_back(operator_identity);
  identities.emplace_back(observer_identity);
  return identities;
}

namespace {

/// The part of a permissions document between <`tag`> and </`tag`>.
std::string section(const std::string& text, const std::string& tag) {
  const std::size_t begin = text.find("<" + tag + ">");
  const std::size_t end = text.find("</" + tag + ">");
  return begin < end && end != std::string::npos ? text.substr(begin, end - begin) : "";
}

bool grants(const std::string& text, const std::string& verb,
            const std::vector<std::string>& topics) {
  const std::string granted = section(text, verb);
  return std::all_of(topics.begin(), topics.end(), [&](const std::string& topic) {
    return granted.find("<topic>" + topic + "</topic>") != std::string::npos;
  });
}

class Check {
 public:
  Check(const Deployment& deployment, const std::string& identity)
      : deployment_(deployment), identity_(identity) {}

  std::vector<std::string> run() {
    const auto& security = *deployment_.security;
    const std::string directory = security.directory.string();
    const std::string copy_trust =
        "copy trust of the key directory to this host (quoin keys init " + directory +
        " makes one)";
    const std::string make = "quoin keys add " + directory + " " + identity_;
    const std::string renew =
        "quoin keys permissions " + directory + " " + deployment_.file.string() + " renews it";
    const auto folder = identity_folder(security.directory, identity_);
    require_folder(security.directory / "trust", copy_trust);
    require_folder(folder, make + " makes it, on the host of the authority; copy it here");
    if (!problems_.empty()) return problems_;
    const TrustFiles trust = trust_files(security.directory, security.encrypt);
    const IdentityFiles files = identity_files(security.directory, identity_);
    const std::string authority = read(trust.authority, copy_trust);
    const std::string revoked = read(trust.revoked, copy_trust);
    const std::string governance = read(trust.governance, copy_trust);
    const std::string certificate = read(files.certificate, make + " --force makes it");
    const std::string private_key = read(files.private_key, make + " makes it");
    check_mode(files.private_key);
    const std::string permissions = read(files.permissions, renew);
    if (!problems_.empty()) return problems_;
    attempt(trust.authority, copy_trust, [&] {
      const OpensslCertificate issuer = parse_certificate(authority);
      attempt(trust.governance, renew + ", then copy trust to each host", [&] {
        if (verify_document(governance, issuer.get()) != governance_text(security.encrypt)) {
          throw std::runtime_error("is of another version of quoin");
        }
      });
      attempt(files.certificate, make + " --force renews it", [&] {
        const OpensslCertificate own = parse_certificate(certificate);
        const std::string reason =
            objection(own.get(), issuer.get(), parse_revocation_list(revoked).get());
        if (!reason.empty()) throw std::runtime_error(reason);
        if (X509_check_private_key(own.get(), parse_private_key(private_key).get()) != 1) {
          throw openssl_error("use it with " + files.private_key.string());
        }
      });
      attempt(files.permissions, renew,
              [&] { check_permissions(verify_document(permissions, issuer.get())); });
    });
    return problems_;
  }

 private:
  void add(const std::string& what, const std::string& way_out) {
    problems_.push_back(deployment_.file.string() + ": security: " + what + "; " + way_out);
  }

  void require_folder(const std::filesystem::path& folder, const std::string& way_out) {
    if (!std::filesystem::is_directory(folder))
      add("there is no folder " + folder.string(), way_out);
  }

  /// Whoever reads a key can speak as its owner.
  void check_mode(const std::filesystem::path& key) {
    std::error_code error;
    const auto mode = std::filesystem::status(key, error).permissions();
    using enum std::filesystem::perms;
    if (error || (mode & (group_all | others_all)) == none) return;
    add(key.string() + " can be read or changed by others than its owner",
        "chmod 600 " + key.string() + ", and replace it if somebody has (quoin keys add --force)");
  }

  std::string read(const std::filesystem::path& file, const std::string& way_out) {
    try {
      return read_file(file);
    } catch (const std::runtime_error& error) {
      add(error.what(), way_out);
      return "";
    }
  }

  template <class Function>
  void attempt(const std::filesystem::path& file, const std::string& way_out, Function function) {
    try {
      function();
    } catch (const std::runtime_error& error) {
      add(file.string() + ": " + error.what(), way_out);
    }
  }

  void check_permissions(const std::string& text) const {
    const TopicRule rule = rule_of(deployment_, identity_);
    if (section(text, "not_after") <=
        "<not_after>" + permissions_time(std::chrono::system_clock::now())) {
      throw std::runtime_error("the permissions have expired");
    }
    if (text.find("<id>" + std::to_string(rule.domain) + "</id>") == std::string::npos ||
        !grants(text, "publish", rule.writes) || !grants(text, "subscribe", rule.reads)) {
      throw std::runtime_error(
          "the permissions were made for other topics than the deployment has");
    }
  }

  const Deployment& deployment_;
  const std::string& identity_;
  std::vector<std::string> problems_;
};

}  // namespace

std::vector<std::string> key_problems(const Deployment& deployment, const std::string& identity) {
  if (!deployment.security) return {};
  return Check(deployment, identity).run();
}

void require_keys(const Deployment& deployment, const std::vector<std::string>& identities) {
  std::vector<std::string> problems;
  for (const std::string& identity : identities) {
    for (std::string& problem : key_problems(deployment, identity)) {
      // All identities share the files of the authority.
      if (std::find(problems.begin(), problems.end(), problem) == problems.end()) {
        problems.push_back(std::move(problem));
      }
    }
  }
  if (!problems.empty()) throw DeploymentError(std::move(problems));
}

std::string authority_name(const std::filesystem::path& directory) {
  return common_name(parse_certificate(read_file(trust_files(directory, true).authority)).get());
}

std::chrono::system_clock::time_point certificate_end(const std::filesystem::path& directory,
                                                      const std::string& identity) {
  return valid_until(
      parse_certificate(read_file(identity_files(directory, identity).certificate)).get());
}

}  // namespace quoin
