// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>

#include "services/runtime/dds/fast_dds.hpp"
#include "services/runtime/dds/last_heard.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::runtime {

/// What the writers and readers of a topic must agree on before messages flow.
struct EndpointPolicies {
  std::string type;
  int durability = 0;
  int reliability = 0;
  int ownership = 0;
  int liveliness = 0;
  std::int64_t lease = 0;     // [ns] of the liveliness
  std::int64_t deadline = 0;  // [ns]
  std::string digest = {};    // of the fields of the type (topics::type_digest), where announced
};

/// What an endpoint of that type announces in its user data: "" for types that are not of idl/.
[[nodiscard]] std::string type_announcement(std::string_view dds_type);
/// The digest in anybody's user data; "" when there is none.
[[nodiscard]] std::string announced_digest(std::string_view user_data);
/// Whether both are known, and of different fields.
[[nodiscard]] bool differ(std::string_view digest, std::string_view other);

[[nodiscard]] Guid guid_of(const fast_dds::rtps::GUID_t& guid);

/// What another participant calls itself or its topics, fit for a log.
[[nodiscard]] std::string foreign_name(std::string_view text);

/// What a participant announces as its user data: `text`, and behind a zero, where ROS 2 reads no
/// further, the topics that it observes. Bounded, so that the announcement stays one datagram: of
/// more than 128 topics the rest is left out. Only an announcement with another `number` than the
/// last is sent at once.
[[nodiscard]] std::vector<std::uint8_t> participant_announcement(
    const std::string& text, const std::vector<std::string>& topics, std::uint32_t number);

[[nodiscard]] EndpointPolicies policies_of(const eprosima::fastdds::dds::DataWriter& writer);
[[nodiscard]] EndpointPolicies policies_of(const eprosima::fastdds::dds::DataReader& reader);

/// The endpoints of all other participants in the domain, as discovery reports them: DDS says that
/// an endpoint does not fit, but not whose it is and what that one asks for.
class KnownEndpoints : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  using Prefix = std::array<std::uint8_t, 12>;  // of the participant

  /// `own_name`: of this participant, <namespace>/<label>.
  explicit KnownEndpoints(std::string own_name);

  /// Which readers of `topic` do not fit a writer of this participant, one line for each policy:
  /// "<topic>: durability: walls offers volatile, map requests transient-local".
  [[nodiscard]] std::vector<std::string> mismatches_of_writer(
      const std::string& topic, const EndpointPolicies& offered) const;
  /// Which writers of `topic` do not fit a reader of this participant.
  [[nodiscard]] std::vector<std::string> mismatches_of_reader(
      const std::string& topic, const EndpointPolicies& requested) const;
  /// What a writer announces.
  struct Announced {
    std::uint64_t incarnation = 0;  // announced_incarnation
    std::string digest = {};        // announced_digest
  };
  /// Nothing when it has not been discovered.
  [[nodiscard]] std::optional<Announced> announced_by_writer(const Guid& writer) const;
  /// Topics that others write to.
  [[nodiscard]] std::vector<std::string> written_topics() const;
  /// The same with what they are written as; one with writers of several types by that of the
  /// first.
  [[nodiscard]] std::vector<WrittenTopic> written() const;

  /// Number of participants discovered so far, once it is above `seen` or a stop is requested.
  [[nodiscard]] std::uint64_t wait_for_new_participant(std::uint64_t seen,
                                                       std::stop_token stop) const;
  /// When the newest of them was discovered; the start of time before the first.
  [[nodiscard]] std::chrono::steady_clock::time_point newest_participant() const;
  /// True if DDS checks the lease of one that lives: among clients, that of a discovery server.
  [[nodiscard]] bool knows_server() const;

  /// Names of the participants that announced that they observe `topic`, do not ask for what a
  /// writer that offers this cannot give, and are not among `matched`.
  [[nodiscard]] std::vector<std::string> awaited_observers(const std::string& topic,
                                                           const EndpointPolicies& offered,
                                                           const std::set<Prefix>& matched) const;

  /// Names of those among `participants` that have been silent for longer than their lease, after
  /// `own` was made to drop them when it would not by itself. With Fast DDS 3 and without a
  /// discovery server, where it always does, there are none.
  [[nodiscard]] std::vector<std::string> check_silent(
      const std::set<Prefix>& participants, eprosima::fastdds::dds::DomainParticipant& own);

  // What Fast DDS calls, of either version.
#ifdef QUOIN_FAST_DDS_2
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                fast_dds::rtps::ParticipantDiscoveryInfo&& info) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              fast_dds::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               fast_dds::rtps::ReaderDiscoveryInfo&& info) override;
#else
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                fast_dds::rtps::ParticipantDiscoveryStatus status,
                                const fast_dds::rtps::ParticipantBuiltinTopicData& info,
                                bool& should_be_ignored) override;
  void on_data_writer_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                fast_dds::rtps::WriterDiscoveryStatus status,
                                const fast_dds::rtps::PublicationBuiltinTopicData& info,
                                bool& should_be_ignored) override;
  void on_data_reader_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                fast_dds::rtps::ReaderDiscoveryStatus status,
                                const fast_dds::rtps::SubscriptionBuiltinTopicData& info,
                                bool& should_be_ignored) override;

  [[nodiscard]] std::shared_ptr<LastHeard> last_heard() const { return last_heard_; }
#endif

 private:
  struct Known {
    std::string name;
    std::set<std::uint32_t> observes;  // topics, as announced_topic
    // A discovery server that lives knows it, and reports its end.
    bool vouched = true;
#ifdef QUOIN_FAST_DDS_2
    // What DDS holds about it, valid until its removal has been reported.
    const fast_dds::rtps::ParticipantProxyData* proxy = nullptr;
    bool lease_check_added = false;
#else
    bool server = false;
    std::chrono::nanoseconds lease{};
#endif
  };
  struct Endpoint {
    Prefix participant{};
    std::string topic;
    EndpointPolicies policies;
    std::uint64_t incarnation = 0;  // of a writer: announced
  };

  [[nodiscard]] std::string name_of(const Prefix& participant) const;
  [[nodiscard]] static bool checks_lease(const Known& known);
  /// Its newest announcement, of anybody; with `mutex_` locked, as the next one is called.
  Known& learn(const Prefix& participant, const std::string& name,
               const std::vector<std::uint8_t>& user_data, bool is_new);
  void forget(const Prefix& participant);

  const std::string own_name_;
  mutable std::mutex mutex_;
  mutable std::condition_variable_any discovered_changed_;
  std::uint64_t discovered_ = 0;
  std::chrono::steady_clock::time_point newest_{};
  std::map<Prefix, Known> participants_;
  std::map<Guid, Endpoint> writers_;
  std::map<Guid, Endpoint> readers_;
#ifndef QUOIN_FAST_DDS_2
  const std::shared_ptr<LastHeard> last_heard_ = std::make_shared<LastHeard>();
#endif
};

}  // namespace quoin::runtime
