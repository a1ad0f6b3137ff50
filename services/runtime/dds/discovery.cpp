// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/discovery.hpp"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDescription.hpp>

#include "core/text/printable.hpp"
#include "services/runtime/dds/process_writers.hpp"
#include "services/topics/type_digest.hpp"

namespace quoin::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = fast_dds::rtps;

Guid guid_of(const rtps::GUID_t& guid) {
  Guid bytes{};
  std::copy_n(guid.guidPrefix.value, 12, bytes.begin());
  std::copy_n(guid.entityId.value, 4, bytes.begin() + 12);
  return bytes;
}

std::string foreign_name(std::string_view text) { return printable(text, Lines::one, 80); }

namespace {

// Names come from anybody in the domain and go to terminals and heartbeats.
constexpr std::size_t most_misfits = 32;

// What user data has that announces topics. Numbers of 32 bits follow, least significant
// byte first: that of the announcement, then one for each topic. The names of all topics of a
// deployment would not fit into a datagram, and two that share a number cost a start no more than a
// wait for nobody.
constexpr std::string_view announcement_begin = "quoin observes:";
constexpr std::size_t most_announced = 128;

// What user data of an endpoint has in front of the digest of its type.
constexpr std::string_view type_begin = "quoin type ";
constexpr std::size_t digest_size = 8;

// How many leases a reader may be silent that a living discovery server knows. The server itself
// drops it after one.
constexpr int leases_when_vouched = 3;

/// FNV-1a.
std::uint32_t announced_topic(const std::string& topic) {
  std::uint32_t hash = 2166136261U;
  for (const char character : topic) {
    hash = (hash ^ static_cast<std::uint8_t>(character)) * 16777619U;
  }
  return hash;
}

/// Of anybody's user data: none when it is no announcement.
std::set<std::uint32_t> announced_topics(const std::vector<std::uint8_t>& data) {
  std::set<std::uint32_t> topics;
  const auto begin =
      std::search(data.begin(), data.end(), announcement_begin.begin(), announcement_begin.end());
  if (begin == data.end()) return topics;
  for (std::size_t i =
           static_cast<std::size_t>(begin - data.begin()) + announcement_begin.size() + 4;
       i + 4 <= data.size() && topics.size() < most_announced; i += 4) {
    topics.insert(data[i] | static_cast<std::uint32_t>(data[i + 1]) << 8U |
                  static_cast<std::uint32_t>(data[i + 2]) << 16U |
                  static_cast<std::uint32_t>(data[i + 3]) << 24U);
  }
  return topics;
}

std::string chosen(const std::vector<const char*>& names, int value) {
  const auto index = static_cast<std::size_t>(value);
  return index < names.size() ? names[index] : "kind " + std::to_string(value);
}

std::string durability_name(int kind) {
  return chosen({"volatile", "transient-local", "transient", "persistent"}, kind);
}
std::string reliability_name(int kind) { return chosen({"?", "best effort", "reliable"}, kind); }
std::string ownership_name(int kind) { return chosen({"shared", "exclusive"}, kind); }
std::string liveliness_name(int kind) {
  return chosen({"automatic", "manual by participant", "manual by topic"}, kind);
}
std::string time_text(std::int64_t nanoseconds) {
  if (nanoseconds >= 1'000'000'000LL * 3600 * 24 * 365) return "none";
  return std::to_string(nanoseconds / 1'000'000) + " ms";
}

template <class Bytes>
std::string digest_in(const Bytes& user_data) {
  return announced_digest({reinterpret_cast<const char*>(user_data.data()), user_data.size()});
}

// The policies of discovery data have other names than those of the DDS classes.
#ifdef QUOIN_FAST_DDS_2
template <class Data>
EndpointPolicies discovered(const Data& data) {
  const auto& qos = data.m_qos;
  return {foreign_name(data.typeName().to_string()),
          qos.m_durability.kind,
          qos.m_reliability.kind,
          static_cast<int>(qos.m_ownership.kind),
          qos.m_liveliness.kind,
          qos.m_liveliness.lease_duration.to_ns(),
          qos.m_deadline.period.to_ns(),
          digest_in(qos.m_userData.getValue())};
}
#else
template <class Data>
EndpointPolicies discovered(const Data& data) {
  return {foreign_name(data.type_name.to_string()),
          data.durability.kind,
          data.reliability.kind,
          static_cast<int>(data.ownership.kind),
          data.liveliness.kind,
          data.liveliness.lease_duration.to_ns(),
          data.deadline.period.to_ns(),
          digest_in(data.user_data.getValue())};
}
#endif

template <class Qos>
EndpointPolicies own(const Qos& qos, const std::string& type) {
  return {type,
          qos.durability().kind,
          qos.reliability().kind,
          static_cast<int>(qos.ownership().kind),
          qos.liveliness().kind,
          qos.liveliness().lease_duration.to_ns(),
          qos.deadline().period.to_ns(),
          digest_in(qos.user_data().getValue())};
}

struct Mismatch {
  std::string policy, offered, requested;
};

std::string fields_text(const EndpointPolicies& policies) {
  return policies.type + " with the fields " + policies.digest;
}

std::vector<Mismatch> mismatches(const EndpointPolicies& offered,
                                 const EndpointPolicies& requested) {
  std::vector<Mismatch> found;
  if (offered.type != requested.type) return {{"type", offered.type, requested.type}};
  if (differ(offered.digest, requested.digest)) {
    return {{"type", fields_text(offered), fields_text(requested)}};
  }
  const auto check = [&](bool fits, const char* policy, std::string offers, std::string requests) {
    if (!fits) found.push_back({policy, std::move(offers), std::move(requests)});
  };
  check(offered.durability >= requested.durability, "durability",
        durability_name(offered.durability), durability_name(requested.durability));
  check(offered.reliability >= requested.reliability, "reliability",
        reliability_name(offered.reliability), reliability_name(requested.reliability));
  check(offered.ownership == requested.ownership, "ownership", ownership_name(offered.ownership),
        ownership_name(requested.ownership));
  check(offered.liveliness >= requested.liveliness, "liveliness",
        liveliness_name(offered.liveliness), liveliness_name(requested.liveliness));
  check(offered.lease <= requested.lease, "lease", time_text(offered.lease),
        time_text(requested.lease));
  check(offered.deadline <= requested.deadline, "deadline", time_text(offered.deadline),
        time_text(requested.deadline));
  return found;
}

void add_misfits(const std::string& topic, const std::string& writer,
                 const EndpointPolicies& offered, const std::string& reader,
                 const EndpointPolicies& requested, std::vector<std::string>& texts) {
  for (const Mismatch& mismatch : mismatches(offered, requested)) {
    std::string text = topic + ": " + mismatch.policy + ": " + writer + " offers " +
                       mismatch.offered + ", " + reader + " requests " + mismatch.requested;
    const bool known = std::find(texts.begin(), texts.end(), text) != texts.end();
    if (!known && texts.size() < most_misfits) texts.push_back(std::move(text));
  }
}

std::array<std::uint8_t, 12> prefix_of(const rtps::GUID_t& guid) {
  std::array<std::uint8_t, 12> prefix{};
  std::copy_n(guid.guidPrefix.value, prefix.size(), prefix.begin());
  return prefix;
}

std::uint64_t incarnation_in(const std::vector<rtps::octet>& user_data) {
  return announced_incarnation({reinterpret_cast<const char*>(user_data.data()), user_data.size()});
}

#ifdef QUOIN_FAST_DDS_2
// Discovery data belong to Fast DDS, which lends them to its listeners read-only, but asks for no
// more than this flag when the timer of a lease ends.
void set_lease_check(const rtps::ParticipantProxyData& participant, bool wanted) {
  const_cast<rtps::ParticipantProxyData&>(participant).should_check_lease_duration = wanted;
}
#else
// As network_qos makes it.
bool is_server(const rtps::GuidPrefix_t& prefix) {
  return prefix.value[0] == 'Q' && prefix.value[1] == 'n' && prefix.value[3] == 1;
}
#endif

}  // namespace

std::string type_announcement(std::string_view dds_type) {
  const std::string_view digest = topics::type_digest(dds_type);
  return digest.empty() ? "" : std::string(type_begin).append(digest).append(";");
}

std::string announced_digest(std::string_view user_data) {
  const std::size_t begin = user_data.find(type_begin);
  if (begin == std::string_view::npos) return "";
  const std::string_view rest = user_data.substr(begin + type_begin.size());
  const std::string_view digest = rest.substr(0, digest_size);
  const bool whole = rest.size() > digest_size && rest[digest_size] == ';' &&
                     digest.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  return whole ? std::string(digest) : "";
}

bool differ(std::string_view digest, std::string_view other) {
  return !digest.empty() && !other.empty() && digest != other;
}

std::vector<std::uint8_t> participant_announcement(const std::string& text,
                                                   const std::vector<std::string>& topics,
                                                   std::uint32_t number) {
  std::vector<std::uint8_t> data(text.begin(), text.end());
  if (topics.empty()) return data;
  if (!text.empty()) data.push_back(0);
  data.insert(data.end(), announcement_begin.begin(), announcement_begin.end());
  const auto add = [&](std::uint32_t value) {
    for (unsigned shift = 0; shift < 32U; shift += 8U) {
      data.push_back(static_cast<std::uint8_t>(value >> shift));
    }
  };
  add(number);
  for (std::size_t i = 0; i < std::min(topics.size(), most_announced); ++i) {
    add(announced_topic(topics[i]));
  }
  return data;
}

EndpointPolicies policies_of(const dds::DataWriter& writer) {
  return own(writer.get_qos(), writer.get_topic()->get_type_name());
}

EndpointPolicies policies_of(const dds::DataReader& reader) {
  return own(reader.get_qos(), reader.get_topicdescription()->get_type_name());
}

KnownEndpoints::KnownEndpoints(std::string own_name) : own_name_(std::move(own_name)) {}

// Without the namespace that it shares with this participant.
std::string KnownEndpoints::name_of(const Prefix& participant) const {
  const auto known = participants_.find(participant);
  if (known == participants_.end() || known->second.name.empty()) {
    return "a participant without name";
  }
  const std::size_t slash = own_name_.rfind('/');
  const std::string name_space = own_name_.substr(0, slash == std::string::npos ? 0 : slash + 1);
  const std::string& name = known->second.name;
  return name.starts_with(name_space) ? name.substr(name_space.size()) : name;
}

std::vector<std::string> KnownEndpoints::mismatches_of_writer(
    const std::string& topic, const EndpointPolicies& offered) const {
  const std::string own = own_name_.substr(own_name_.rfind('/') + 1);
  std::vector<std::string> texts;
  const std::lock_guard lock(mutex_);
  for (const auto& [guid, reader] : readers_) {
    if (reader.topic != topic) continue;
    add_misfits(topic, own, offered, name_of(reader.participant), reader.policies, texts);
  }
  return texts;
}

std::vector<std::string> KnownEndpoints::mismatches_of_reader(
    const std::string& topic, const EndpointPolicies& requested) const {
  const std::string own = own_name_.substr(own_name_.rfind('/') + 1);
  std::vector<std::string> texts;
  const std::lock_guard lock(mutex_);
  for (const auto& [guid, writer] : writers_) {
    if (writer.topic != topic) continue;
    add_misfits(topic, name_of(writer.participant), writer.policies, own, requested, texts);
  }
  return texts;
}

std::vector<WrittenTopic> KnownEndpoints::written() const {
  std::map<std::string, WrittenTopic> topics;
  const std::lock_guard lock(mutex_);
  for (const auto& [guid, writer] : writers_) {
    WrittenTopic& topic =
        topics.try_emplace(writer.topic, WrittenTopic{writer.topic, writer.policies.type})
            .first->second;
    topic.reliable &= writer.policies.reliability >= dds::RELIABLE_RELIABILITY_QOS;
    topic.transient_local &= writer.policies.durability >= dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  }
  std::vector<WrittenTopic> all;
  for (auto& [name, topic] : topics) all.push_back(std::move(topic));
  return all;
}

std::vector<std::string> KnownEndpoints::written_topics() const {
  std::vector<std::string> topics;
  const std::lock_guard lock(mutex_);
  for (const auto& [guid, writer] : writers_) topics.push_back(writer.topic);
  std::sort(topics.begin(), topics.end());
  topics.erase(std::unique(topics.begin(), topics.end()), topics.end());
  return topics;
}

std::vector<std::string> KnownEndpoints::awaited_observers(const std::string& topic,
                                                           const EndpointPolicies& offered,
                                                           const std::set<Prefix>& matched) const {
  std::vector<std::string> names;
  const std::uint32_t wanted = announced_topic(topic);
  const std::lock_guard lock(mutex_);
  std::set<Prefix> unfit;
  for (const auto& [guid, reader] : readers_) {
    if (reader.topic == topic && !mismatches(offered, reader.policies).empty()) {
      unfit.insert(reader.participant);
    }
  }
  for (const auto& [prefix, known] : participants_) {
    if (!known.observes.contains(wanted)) continue;
    if (!matched.contains(prefix) && !unfit.contains(prefix)) names.push_back(name_of(prefix));
  }
  return names;
}

std::uint64_t KnownEndpoints::wait_for_new_participant(std::uint64_t seen,
                                                       std::stop_token stop) const {
  std::unique_lock lock(mutex_);
  discovered_changed_.wait(lock, std::move(stop), [&] { return discovered_ > seen; });
  return discovered_;
}

std::chrono::steady_clock::time_point KnownEndpoints::newest_participant() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

bool KnownEndpoints::knows_server() const {
  const std::lock_guard lock(mutex_);
  return std::any_of(participants_.begin(), participants_.end(),
                     [](const auto& entry) { return checks_lease(entry.second); });
}

// DDS checks the lease of all others itself, except among clients of a discovery server.
bool KnownEndpoints::checks_lease(const Known& known) {
#ifdef QUOIN_FAST_DDS_2
  return known.proxy->should_check_lease_duration && !known.lease_check_added;
#else
  return known.server;
#endif
}

KnownEndpoints::Known& KnownEndpoints::learn(const Prefix& participant, const std::string& name,
                                             const std::vector<std::uint8_t>& user_data,
                                             bool is_new) {
  if (is_new) {
    ++discovered_;
    newest_ = std::chrono::steady_clock::now();
    discovered_changed_.notify_all();
  }
  Known& known = participants_[participant];
  known.name = foreign_name(name);
  known.observes = announced_topics(user_data);
  known.vouched = true;
  return known;
}

void KnownEndpoints::forget(const Prefix& participant) {
  const auto theirs = [&](const auto& entry) { return entry.second.participant == participant; };
  std::erase_if(writers_, theirs);
  std::erase_if(readers_, theirs);
  const auto found = participants_.find(participant);
  if (found == participants_.end()) return;
  const bool was_server = checks_lease(found->second);
#ifdef QUOIN_FAST_DDS_2
  // A timer that ends now would find the place of this participant empty, and abort.
  if (!was_server) set_lease_check(*found->second.proxy, false);
#else
  last_heard_->forget(participant);
#endif
  participants_.erase(found);
  const auto lives = [](const auto& entry) { return checks_lease(entry.second); };
  if (!was_server || std::any_of(participants_.begin(), participants_.end(), lives)) return;
  for (auto& [prefix, known] : participants_) known.vouched = false;
}

// Of a participant that a discovery server knows, its end is reported by the server, and what is
// dropped here the server never brings back. A server that was restarted within the lease looks
// like one that lives, though, and knows nothing of the dead.
#ifdef QUOIN_FAST_DDS_2
std::vector<std::string> KnownEndpoints::check_silent(const std::set<Prefix>& participants,
                                                      dds::DomainParticipant&) {
  std::vector<std::string> silent;
  const auto now = std::chrono::steady_clock::now();
  const std::lock_guard lock(mutex_);
  for (const Prefix& prefix : participants) {
    const auto found = participants_.find(prefix);
    if (found == participants_.end()) continue;
    Known& known = found->second;
    const auto lease = std::chrono::nanoseconds(known.proxy->m_leaseDuration.to_ns());
    const auto silence = now - known.proxy->last_received_message_tm();
    if (silence > lease) silent.push_back(name_of(prefix));
    if (checks_lease(known)) continue;
    const bool drop = silence > (known.vouched ? leases_when_vouched : 1) * lease;
    // The check goes on for as long as it is wanted, and would end a pair that has nothing to say
    // to each other.
    known.lease_check_added = drop;
    set_lease_check(*known.proxy, drop);
    if (drop) {
      known.proxy->lease_duration_event->update_interval_millisec(0.0);
      known.proxy->lease_duration_event->restart_timer();
    }
  }
  return silent;
}

void KnownEndpoints::on_participant_discovery(dds::DomainParticipant*,
                                              rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const std::lock_guard lock(mutex_);
  const Prefix prefix = prefix_of(info.info.m_guid);
  if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
    forget(prefix);
  } else {
    learn(prefix, info.info.m_participantName.to_string(), info.info.m_userData,
          info.status == Info::DISCOVERED_PARTICIPANT)
        .proxy = &info.info;
  }
}

void KnownEndpoints::on_publisher_discovery(dds::DomainParticipant*,
                                            rtps::WriterDiscoveryInfo&& info) {
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
    writers_.erase(guid_of(info.info.guid()));
  } else {
    writers_[guid_of(info.info.guid())] = {prefix_of(info.info.guid()),
                                           info.info.topicName().to_string(), discovered(info.info),
                                           incarnation_in(info.info.m_qos.m_userData.getValue())};
  }
}

void KnownEndpoints::on_subscriber_discovery(dds::DomainParticipant*,
                                             rtps::ReaderDiscoveryInfo&& info) {
  const std::lock_guard lock(mutex_);
  if (info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER) {
    readers_.erase(guid_of(info.info.guid()));
  } else {
    readers_[guid_of(info.info.guid())] = {
        prefix_of(info.info.guid()), info.info.topicName().to_string(), discovered(info.info)};
  }
}
#else
std::vector<std::string> KnownEndpoints::check_silent(const std::set<Prefix>& participants,
                                                      dds::DomainParticipant& own) {
  std::vector<std::string> silent;
  std::vector<Prefix> dropped;
  {
    const auto now = std::chrono::steady_clock::now();
    const std::lock_guard lock(mutex_);
    for (const Prefix& prefix : participants) {
      const auto found = participants_.find(prefix);
      const auto heard = last_heard_->of(prefix);
      if (found == participants_.end() || !heard) continue;
      const Known& known = found->second;
      const auto silence = now - *heard;
      if (silence > known.lease) silent.push_back(name_of(prefix));
      if (checks_lease(known)) continue;
      if (silence > (known.vouched ? leases_when_vouched : 1) * known.lease) {
        dropped.push_back(prefix);
      }
    }
  }
  // It calls the listener.
  for (const Prefix& prefix : dropped) {
    rtps::GUID_t guid;
    std::copy_n(prefix.begin(), prefix.size(), guid.guidPrefix.value);
    guid.entityId = rtps::c_EntityId_RTPSParticipant;
    (void)own.ignore_participant(guid);
  }
  return silent;
}

void KnownEndpoints::on_participant_discovery(dds::DomainParticipant*,
                                              rtps::ParticipantDiscoveryStatus status,
                                              const rtps::ParticipantBuiltinTopicData& info,
                                              bool& should_be_ignored) {
  using Status = rtps::ParticipantDiscoveryStatus;
  should_be_ignored = false;
  const std::lock_guard lock(mutex_);
  const Prefix prefix = prefix_of(info.guid);
  if (status == Status::DISCOVERED_PARTICIPANT || status == Status::CHANGED_QOS_PARTICIPANT) {
    const bool is_new = status == Status::DISCOVERED_PARTICIPANT;
    Known& known =
        learn(prefix, info.participant_name.to_string(), info.user_data.getValue(), is_new);
    known.server = is_server(info.guid.guidPrefix);
    known.lease = std::chrono::nanoseconds(info.lease_duration.to_ns());
    if (is_new) last_heard_->watch(prefix);
  } else {
    forget(prefix);
  }
}

void KnownEndpoints::on_data_writer_discovery(dds::DomainParticipant*,
                                              rtps::WriterDiscoveryStatus status,
                                              const rtps::PublicationBuiltinTopicData& info,
                                              bool& should_be_ignored) {
  should_be_ignored = false;
  const std::lock_guard lock(mutex_);
  if (status == rtps::WriterDiscoveryStatus::REMOVED_WRITER) {
    writers_.erase(guid_of(info.guid));
  } else {
    writers_[guid_of(info.guid)] = {prefix_of(info.guid), info.topic_name.to_string(),
                                    discovered(info), incarnation_in(info.user_data.getValue())};
  }
}

void KnownEndpoints::on_data_reader_discovery(dds::DomainParticipant*,
                                              rtps::ReaderDiscoveryStatus status,
                                              const rtps::SubscriptionBuiltinTopicData& info,
                                              bool& should_be_ignored) {
  should_be_ignored = false;
  const std::lock_guard lock(mutex_);
  if (status == rtps::ReaderDiscoveryStatus::REMOVED_READER) {
    readers_.erase(guid_of(info.guid));
  } else {
    readers_[guid_of(info.guid)] = {prefix_of(info.guid), info.topic_name.to_string(),
                                    discovered(info)};
  }
}
#endif

std::optional<KnownEndpoints::Announced> KnownEndpoints::announced_by_writer(
    const Guid& writer) const {
  const std::lock_guard lock(mutex_);
  const auto known = writers_.find(writer);
  if (known == writers_.end()) return std::nullopt;
  return Announced{known->second.incarnation, known->second.policies.digest};
}

}  // namespace quoin::runtime
