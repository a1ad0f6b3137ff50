// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>

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
};

[[nodiscard]] EndpointPolicies policies_of(const eprosima::fastdds::dds::DataWriter& writer);
[[nodiscard]] EndpointPolicies policies_of(const eprosima::fastdds::dds::DataReader& reader);

/// The endpoints of all other participants in the domain, as discovery tells of them: DDS says that
/// an endpoint does not fit, but not whose it is and what that one asks for.
class KnownEndpoints : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// `own_name`: of this participant, <namespace>/<label>.
  explicit KnownEndpoints(std::string own_name);

  /// Which readers of `topic` do not fit a writer of this participant, one line for each policy:
  /// "<topic>: durability: walls offers volatile, map requests transient-local".
  [[nodiscard]] std::vector<std::string> misfits_of_writer(const std::string& topic,
                                                           const EndpointPolicies& offered) const;
  /// Which writers of `topic` do not fit a reader of this participant.
  [[nodiscard]] std::vector<std::string> misfits_of_reader(const std::string& topic,
                                                           const EndpointPolicies& requested) const;
  /// Topics that others write to.
  [[nodiscard]] std::vector<std::string> written_topics() const;

  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;

 private:
  using Prefix = std::array<std::uint8_t, 12>;  // of the participant
  using Guid = std::array<std::uint8_t, 16>;
  struct Endpoint {
    Prefix participant{};
    std::string topic;
    EndpointPolicies policies;
  };

  [[nodiscard]] std::string name_of(const Prefix& participant) const;

  const std::string own_name_;
  mutable std::mutex mutex_;
  std::map<Prefix, std::string> participants_;
  std::map<Guid, Endpoint> writers_;
  std::map<Guid, Endpoint> readers_;
};

}  // namespace quoin::runtime
