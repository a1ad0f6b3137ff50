// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "services/runtime/dds/participant_impl.hpp"
#include "services/runtime/dds/reader.hpp"
#include "services/runtime/dds/writer.hpp"
#include "services/topics/cdr_codec.hpp"

namespace quoin::runtime {

/// What readers and writers give to DDS in place of a message.
struct CdrSample {
  void* message = nullptr;  ///< of the codec's type; a topics::RawMessage where there is no codec
  const topics::CdrCodec* codec = nullptr;
};

/// DDS type whose samples are CdrSample. A participant registers a type once, whoever comes first;
/// as each sample says how it is written and read, typed and raw endpoints share it.
class CdrType : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// `codec` is null for a type of which only the name is known; it has no key then.
  CdrType(const std::string& name, const topics::CdrCodec* codec);

  bool serialize(void* sample, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* sample) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override;
  bool getKey(void* sample, eprosima::fastrtps::rtps::InstanceHandle_t* handle,
              bool force_md5) override;
  // Samples that own their message; Fast DDS makes some for loans, and one to find out keys.
  void* createData() override;
  void deleteData(void* sample) override;

 private:
  const topics::CdrCodec* key_codec_;  // null when the type has no key
};

/// A new CdrType.
[[nodiscard]] eprosima::fastdds::dds::TypeSupport type_support(const std::string& name,
                                                               const topics::CdrCodec* codec);

struct ReaderBase::Impl : eprosima::fastdds::dds::DataReaderListener {
  Impl(Participant& owner, const std::string& topic, const std::string& type_name,
       const topics::CdrCodec* codec, const TopicQos& qos);
  ~Impl() override;

  void on_subscription_matched(
      eprosima::fastdds::dds::DataReader*,
      const eprosima::fastdds::dds::SubscriptionMatchedStatus& status) override;

  Participant& participant;
  std::string topic_name;
  MatchState match;
  eprosima::fastdds::dds::DataReader* reader = nullptr;
};

struct WriterBase::Impl : eprosima::fastdds::dds::DataWriterListener {
  Impl(Participant& owner, const std::string& topic, const std::string& type_name,
       const topics::CdrCodec* codec, const TopicQos& qos);
  ~Impl() override;

  void on_publication_matched(
      eprosima::fastdds::dds::DataWriter*,
      const eprosima::fastdds::dds::PublicationMatchedStatus& status) override;

  /// Participants of the matched readers.
  [[nodiscard]] std::set<KnownEndpoints::Prefix> reading_participants() const;

  Participant& participant;
  std::string topic_name;
  MatchState match;
  mutable std::mutex mutex;
  std::set<KnownEndpoints::Guid> readers;  // matched
  bool found_silent = false;               // by the last check
  eprosima::fastdds::dds::DataWriter* writer = nullptr;
};

}  // namespace quoin::runtime
