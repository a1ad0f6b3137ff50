// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/security.hpp"

#include <chrono>
#include <filesystem>

#include <spdlog/spdlog.h>

#include "services/keys/key_check.hpp"
#include "services/keys/key_files.hpp"
#include "services/runtime/dds/refusals.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;

namespace {

constexpr auto soon = std::chrono::hours(24 * 30);

}  // namespace

void add_security(const SecurityConfig& security, const std::string& identity,
                  dds::DomainParticipantQos& qos) {
  const auto directory = std::filesystem::absolute(security.directory);
  const TrustFiles trust = trust_files(directory, security.encrypt);
  const IdentityFiles files = identity_files(directory, identity);
  auto& properties = qos.properties().properties();
  const auto set = [&](const std::string& name, const std::string& value) {
    properties.emplace_back("dds.sec." + name, value);
  };
  const auto set_file = [&](const std::string& name, const std::filesystem::path& file) {
    set(name, "file://" + file.string());
  };
  set("auth.plugin", "builtin.PKI-DH");
  set_file("auth.builtin.PKI-DH.identity_ca", trust.authority);
  set_file("auth.builtin.PKI-DH.identity_crl", trust.revoked);
  set_file("auth.builtin.PKI-DH.identity_certificate", files.certificate);
  set_file("auth.builtin.PKI-DH.private_key", files.private_key);
  set("access.plugin", "builtin.Access-Permissions");
  set_file("access.builtin.Access-Permissions.permissions_ca", trust.authority);
  set_file("access.builtin.Access-Permissions.governance", trust.governance);
  set_file("access.builtin.Access-Permissions.permissions", files.permissions);
  set("crypto.plugin", "builtin.AES-GCM-GMAC");
}

std::unique_ptr<KnownEndpoints> watch_security(const SecurityConfig& security,
                                               const std::string& identity,
                                               const std::string& name) {
  auto listener = tell_refusals(name, authority_name(security.directory));
  const auto left =
      certificate_end(security.directory, identity) - std::chrono::system_clock::now();
  if (left < soon) {
    spdlog::warn("the certificate of '{}' ends in {} days; quoin keys add {} {} --force renews it",
                 identity, std::chrono::duration_cast<std::chrono::hours>(left).count() / 24,
                 security.directory.string(), identity);
  }
  return listener;
}

}  // namespace quoin::runtime
