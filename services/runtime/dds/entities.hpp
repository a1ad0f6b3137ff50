// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "services/runtime/dds/discovery.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/fast_dds.hpp"
#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/process_writers.hpp"
#include "services/runtime/dds/qos.hpp"
#include "services/topics/cdr_codec.hpp"
#include "services/topics/message_check.hpp"

namespace quoin::runtime {

/// See Participant::watch_endpoints. From any thread.
class OwnedEndpoints {
 public:
  using Watcher = std::function<void(const std::vector<OwnedEndpoint>&)>;

  void add(OwnedEndpoint endpoint);
  void remove(const Guid& guid);
  void watch(Watcher watcher);

 private:
  void changed() const;

  std::mutex mutex_;
  std::vector<OwnedEndpoint> endpoints_;
  Watcher watcher_;
};

struct Participant::Impl {
  explicit Impl(std::unique_ptr<KnownEndpoints> others) : endpoints(std::move(others)) {}

  std::unique_ptr<KnownEndpoints> endpoints;  // outlives the participant, which calls it
  eprosima::fastdds::dds::DomainParticipant* participant = nullptr;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;
  Discovery discovery = Discovery::peers;
  std::chrono::steady_clock::time_point created;
  std::jthread answering;  // of an observer; ends before the participant
  OwnedEndpoints owned;

  /// The topic of this name, made at its first use, as its type is; `codec` is null for raw
  /// endpoints. Throws std::runtime_error, also when the topic has another type.
  eprosima::fastdds::dds::Topic* topic(const std::string& name, const std::string& type_name,
                                       const topics::CdrCodec* codec);
};

/// Number of peers of an endpoint, as its listener sees it.
class MatchState {
 public:
  void set_matched(int count);
  [[nodiscard]] std::size_t matched() const;
  [[nodiscard]] bool wait(std::size_t count, std::chrono::milliseconds timeout) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::size_t matched_ = 0;
};

[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicQos& topic);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos(const TopicQos& topic);

/// Discovery asks the ports of this many participants on a host; the port formula of the RTPS
/// standard has room for 119 in a domain.
inline constexpr std::uint32_t max_participants = 100;

/// Transport and discovery of a participant that uses the interfaces of these `addresses` and no
/// others. Throws DeploymentError when it is to be a discovery server at another address.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos network_qos(
    const ParticipantConfig& config, const std::vector<std::string>& addresses);

/// What readers and writers give to DDS in place of a message.
struct CdrSample {
  void* message = nullptr;  ///< of the codec's type; a topics::RawMessage where there is no codec
  const topics::CdrCodec* codec = nullptr;
  /// Of a reader: what the bytes must keep to be read into the message, and why they were not read.
  const topics::MessageCheck* check = nullptr;
  topics::Refusal refusal = {};
};

/// DDS type whose samples are CdrSample. A participant registers a type once, whoever comes first;
/// as each sample says how it is written and read, typed and raw endpoints share it.
class CdrType : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = fast_dds::rtps::SerializedPayload_t;
  using Handle = fast_dds::rtps::InstanceHandle_t;

  /// `codec` is null for a type of which only the name is known; it has no key then.
  CdrType(const std::string& name, const topics::CdrCodec* codec);

  // What Fast DDS calls, of either version.
#ifdef QUOIN_FAST_DDS_2
  bool serialize(void* sample, Payload* payload) override { return write(sample, *payload); }
  bool deserialize(Payload* payload, void* sample) override { return read(*payload, sample); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override {
    return [size = size_of(sample)] { return size; };
  }
  bool getKey(void* sample, Handle* handle, bool force_md5) override {
    return key_of_sample(sample, *handle, force_md5);
  }
  void* createData() override { return create(); }
  void deleteData(void* sample) override { destroy(sample); }
#else
  using Representation = eprosima::fastdds::dds::DataRepresentationId_t;
  bool serialize(const void* sample, Payload& payload, Representation) override {
    return write(sample, payload);
  }
  bool deserialize(Payload& payload, void* sample) override { return read(payload, sample); }
  std::uint32_t calculate_serialized_size(const void* sample, Representation) override {
    return size_of(sample);
  }
  bool compute_key(Payload& payload, Handle& handle, bool force_md5) override {
    return key_of_bytes(reinterpret_cast<const std::byte*>(payload.data), payload.length, handle,
                        force_md5);
  }
  bool compute_key(const void* sample, Handle& handle, bool force_md5) override {
    return key_of_sample(sample, handle, force_md5);
  }
  void* create_data() override { return create(); }
  void delete_data(void* sample) override { destroy(sample); }
#endif

  [[nodiscard]] bool keyed() const { return key_codec_ != nullptr; }

 private:
  static bool write(const void* sample, Payload& payload);
  static bool read(const Payload& payload, void* sample);
  static std::uint32_t size_of(const void* sample);
  bool key_of_sample(const void* sample, Handle& handle, bool force_md5) const;
  bool key_of_bytes(const std::byte* cdr, std::size_t size, Handle& handle, bool force_md5) const;
  bool key_of(const void* message, Handle& handle, bool force_md5) const;
  // Samples that own their message; Fast DDS makes some for loans, and one to find out keys.
  [[nodiscard]] void* create() const;
  static void destroy(void* sample);

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

  void refuse(const std::string& reason);
  /// What the writer announces; `hash` stands for it.
  struct Writer {
    std::uint64_t hash = 0;
    std::uint64_t incarnation = 0;
    bool other_fields = false;  // than this reader's type
  };
  [[nodiscard]] Writer announced_by(std::uint64_t hash, const fast_dds::rtps::GUID_t& writer);

  Participant& participant;
  std::string topic_name;
  const topics::MessageCheck* check;  // of typed messages; null where there is none
  MatchState match;
  ProcessWriters writers;
  Writer last_writer;  // that is known
  std::mutex mutex;
  topics::RefusedCounts refused;
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
  std::set<Guid> readers;     // matched
  bool found_silent = false;  // by the last check
  eprosima::fastdds::dds::DataWriter* writer = nullptr;
};

}  // namespace quoin::runtime
