// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/security.hpp"

#include <memory>
#include <mutex>
#include <sstream>

#include <fastdds/dds/log/Log.hpp>
#include <spdlog/spdlog.h>

#include "deploy/keys/key_files.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

class Refusals : public dds::LogConsumer {
 public:
  void Consume(const dds::Log::Entry& entry) override {
    spdlog::warn("RAW {} {}: {}", entry.context.category,
                 entry.context.function ? entry.context.function : "", entry.message);
  }
};

class Listener : public dds::DomainParticipantListener {
 public:
  void on_participant_discovery(dds::DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    spdlog::warn("DISC {} {} token {}", static_cast<int>(info.status),
                 info.info.m_participantName.c_str(), info.info.identity_token_.is_nil());
  }
  void onParticipantAuthentication(dds::DomainParticipant*,
                                   rtps::ParticipantAuthenticationInfo&& info) override {
    std::ostringstream text;
    text << info.guid;
    spdlog::warn("AUTH {} {}", static_cast<int>(info.status), text.str());
  }
};

}  // namespace

void add_security(const deploy::SecurityConfig& security, const std::string& identity,
                  dds::DomainParticipantQos& qos) {
  const auto directory = std::filesystem::absolute(security.directory);
  const deploy::TrustFiles trust = deploy::trust_files(directory, security.encrypt);
  const deploy::IdentityFiles files = deploy::identity_files(directory, identity);
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

std::unique_ptr<dds::DomainParticipantListener> tell_refusals() {
  static std::once_flag once;
  std::call_once(once, [] {
    dds::Log::ClearConsumers();
    dds::Log::RegisterConsumer(std::make_unique<Refusals>());
    dds::Log::SetVerbosity(dds::Log::Kind::Warning);
  });
  return std::make_unique<Listener>();
}

}  // namespace quoin::runtime
