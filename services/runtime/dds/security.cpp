// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/security.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include <fastdds/dds/log/Log.hpp>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "services/keys/key_files.hpp"
#include "services/runtime/dds/discovery.hpp"
#include "services/runtime/dds/fast_dds.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = fast_dds::rtps;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto pause = std::chrono::minutes(1);  // between two lines of one text
constexpr std::size_t most_texts = 30;           // in that time; intruders choose their names
constexpr std::size_t most_names = 1000;
constexpr const char* command_log = "quoin";

std::string text_of(const rtps::GuidPrefix_t& prefix) {
  std::ostringstream text;
  text << prefix;
  return text.str();
}

/// Services log them; commands, whose output belongs to what they were asked, report errors
/// only.
bool is_command() {
  if (spdlog::default_logger()->name().empty()) {
    spdlog::set_default_logger(spdlog::stderr_color_mt(command_log));
  }
  return spdlog::default_logger()->name() == command_log;
}

/// Of this process, whose participants share the log of Fast DDS.
class Refusals {
 public:
  static Refusals& instance() {
    static Refusals refusals;
    return refusals;
  }

  void report(const std::string& text, spdlog::level::level_enum level = spdlog::level::warn) {
    if (quiet_ && level < spdlog::level::err) return;
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    std::erase_if(reported_, [&](const auto& entry) { return now - entry.second > pause; });
    if (reported_.size() > most_texts || !reported_.emplace(text, now).second) return;
    spdlog::log(level, "{}{}", text,
                reported_.size() > most_texts ? "; more is not reported for a minute" : "");
  }

  void learn(const std::string& prefix, const std::string& name) {
    const std::lock_guard lock(mutex_);
    if (names_.size() < most_names) names_[prefix] = foreign_name(name);
  }
  void forget(const std::string& prefix) {
    const std::lock_guard lock(mutex_);
    names_.erase(prefix);
  }
  /// "participant 'NAME'", or by its GUID.
  std::string participant(const std::string& prefix) {
    const std::lock_guard lock(mutex_);
    const auto found = names_.find(prefix);
    return "participant '" + (found == names_.end() ? prefix : found->second) + "'";
  }

 private:
  Refusals() : quiet_(is_command()) {}

  bool quiet_;
  std::mutex mutex_;
  std::map<std::string, std::string> names_;  // by the prefix of the GUID
  std::map<std::string, Clock::time_point> reported_;
};

/// Takes over the log of Fast DDS, where permissions that are missing show.
class Consumer : public dds::LogConsumer {
 public:
  void Consume(const dds::Log::Entry& entry) override {
    const std::string function = entry.context.function == nullptr ? "" : entry.context.function;
    // The caller reports the same with the GUID.
    if (function.rfind("check_remote_", 0) == 0) return;
    if (tell_missing_permission(entry.message)) return;
    // Where in Fast DDS's sources it was is of no use here.
    Refusals::instance().report(
        "Fast DDS: " + entry.message.substr(0, entry.message.find(" (./src")), spdlog::level::err);
  }

 private:
  /// "Error checking create remote writer GUID (TOPIC topic not found in allow rule. ...)".
  static bool tell_missing_permission(const std::string& message) {
    static const std::string begin = "Error checking create remote ";
    const std::size_t guid = begin.size() + std::string("writer ").size();
    const std::size_t guid_end = message.find('|');
    const std::size_t topic = message.find(" (");
    const std::size_t topic_end = message.find(" topic not found");
    if (message.rfind(begin, 0) != 0 || guid_end == std::string::npos || guid_end < guid ||
        topic == std::string::npos || topic_end == std::string::npos || topic_end < topic + 2) {
      return false;
    }
    const bool writer = message.compare(begin.size(), 6, "writer") == 0;
    Refusals::instance().report(
        "refused " + Refusals::instance().participant(message.substr(guid, guid_end - guid)) +
        (writer ? ": no permission to write " : ": no permission to read ") +
        foreign_name(message.substr(topic + 2, topic_end - topic - 2)));
    return true;
  }
};

class Listener : public KnownEndpoints {
 public:
  Listener(const std::string& own_name, std::string authority)
      : KnownEndpoints(own_name), authority_(std::move(authority)) {}

#ifdef QUOIN_FAST_DDS_2
  void on_participant_discovery(dds::DomainParticipant* participant,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    tell_of(info);
    KnownEndpoints::on_participant_discovery(participant, std::move(info));
  }
#else
  void on_participant_discovery(dds::DomainParticipant* participant,
                                rtps::ParticipantDiscoveryStatus status,
                                const rtps::ParticipantBuiltinTopicData& info,
                                bool& should_be_ignored) override {
    using Status = rtps::ParticipantDiscoveryStatus;
    Refusals& refusals = Refusals::instance();
    const std::string prefix = text_of(info.guid.guidPrefix);
    if (status == Status::DISCOVERED_PARTICIPANT || status == Status::CHANGED_QOS_PARTICIPANT) {
      refusals.learn(prefix, info.participant_name.to_string());
    } else {
      refusals.forget(prefix);
    }
    KnownEndpoints::on_participant_discovery(participant, status, info, should_be_ignored);
  }
#endif

  void onParticipantAuthentication(dds::DomainParticipant*,
                                   rtps::ParticipantAuthenticationInfo&& info) override {
    if (info.status == rtps::ParticipantAuthenticationInfo::AUTHORIZED_PARTICIPANT) return;
    Refusals& refusals = Refusals::instance();
    refusals.report("refused " + refusals.participant(text_of(info.guid.guidPrefix)) +
                    ": its identity is missing, foreign, expired or revoked");
  }

 private:
#ifdef QUOIN_FAST_DDS_2
  void tell_of(const rtps::ParticipantDiscoveryInfo& info) const {
    using Info = rtps::ParticipantDiscoveryInfo;
    Refusals& refusals = Refusals::instance();
    const std::string prefix = text_of(info.info.m_guid.guidPrefix);
    if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
      refusals.forget(prefix);
      return;
    }
    refusals.learn(prefix, info.info.m_participantName.to_string());
    const std::string* authority =
        rtps::DataHolderHelper::find_property_value(info.info.identity_token_, "dds.ca.sn");
    if (authority == nullptr) {
      refusals.report("refused " + refusals.participant(prefix) + ": it has no identity");
    } else if (*authority != "/CN=" + authority_) {
      // A handshake that the other has to begin may never come, hence not left to that.
      refusals.report("refused " + refusals.participant(prefix) +
                      ": its identity is of another authority");
    }
  }
#endif

  std::string authority_;
};

}  // namespace

std::unique_ptr<KnownEndpoints> tell_refusals(const std::string& own_name,
                                              const std::string& authority) {
  static std::once_flag once;
  std::call_once(once, [] {
    (void)Refusals::instance();  // made before, and so gone after, what calls it
    dds::Log::ClearConsumers();
    dds::Log::RegisterConsumer(std::make_unique<Consumer>());
  });
  return std::make_unique<Listener>(own_name, authority);
}

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
