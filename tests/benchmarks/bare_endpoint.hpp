// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include "services/runtime/dds/fast_dds.hpp"

namespace quoin::benchmarks {

namespace names = runtime::fast_dds;  // of either version
namespace fast_dds = eprosima::fastdds::dds;
namespace rtps = names::rtps;

using Bytes = std::vector<std::uint8_t>;

/// Bytes as a DDS type: the cheapest message there is.
class BytesType : public fast_dds::TopicDataType {
 public:
  using Payload = rtps::SerializedPayload_t;
  using Handle = rtps::InstanceHandle_t;

#ifdef QUOIN_FAST_DDS_2
  explicit BytesType(std::uint32_t max_size) {
    setName("quoin::benchmarks::Bytes");
    m_typeSize = max_size + 4;
    m_isGetKeyDefined = false;
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, Payload* payload) override { return write(data, *payload); }
  bool deserialize(Payload* payload, void* data) override { return read(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return size(data); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, Handle*, bool) override { return false; }
#else
  explicit BytesType(std::uint32_t max_size) {
    set_name("quoin::benchmarks::Bytes");
    max_serialized_type_size = max_size + 4;
  }
  using Representation = fast_dds::DataRepresentationId_t;
  bool serialize(const void* data, Payload& payload, Representation) override {
    return write(data, payload);
  }
  bool deserialize(Payload& payload, void* data) override { return read(payload, data); }
  std::uint32_t calculate_serialized_size(const void* data, Representation) override {
    return size(data);
  }
  void* create_data() override { return new Bytes; }
  void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
  bool compute_key(Payload&, Handle&, bool) override { return false; }
  bool compute_key(const void*, Handle&, bool) override { return false; }
#endif

 private:
  static bool write(const void* data, Payload& payload) {
    const Bytes& bytes = *static_cast<const Bytes*>(data);
    payload.encapsulation = CDR_LE;
    payload.length = size(data);
    std::memcpy(payload.data, "\x00\x01\x00\x00", 4);
    std::memcpy(payload.data + 4, bytes.data(), bytes.size());
    return true;
  }
  static bool read(const Payload& payload, void* data) {
    if (payload.length < 4) return false;
    static_cast<Bytes*>(data)->assign(payload.data + 4, payload.data + payload.length);
    return true;
  }
  static std::uint32_t size(const void* data) {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size()) + 4;
  }
};

/// A Fast DDS participant on UDP 127.0.0.1, with nothing of this project.
class BareParticipant {
 public:
  explicit BareParticipant(int domain) {
    rtps::Locator_t loopback;
    loopback.kind = LOCATOR_KIND_UDPv4;
    rtps::IPLocator::setIPv4(loopback, "127.0.0.1");
    auto udp = std::make_shared<names::UdpTransport>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->maxInitialPeersRange = 50;
    udp->sendBufferSize = udp->receiveBufferSize = 4U << 20U;
    fast_dds::DomainParticipantQos qos = fast_dds::PARTICIPANT_QOS_DEFAULT;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    qos.wire_protocol().builtin.initialPeersList.push_back(loopback);
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(loopback);
    qos.wire_protocol().default_unicast_locator_list.push_back(loopback);
    participant_ = fast_dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fast_dds::DomainId_t>(domain), qos);
    if (participant_ == nullptr) throw std::runtime_error("cannot create a bare participant");
    fast_dds::TypeSupport(new BytesType(1U << 16U)).register_type(participant_);
    publisher_ = participant_->create_publisher(fast_dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(fast_dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~BareParticipant() {
    participant_->delete_contained_entities();
    fast_dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  BareParticipant(const BareParticipant&) = delete;
  BareParticipant& operator=(const BareParticipant&) = delete;

  fast_dds::DataWriter* writer(const std::string& topic, bool lossless) {
    auto qos = common(fast_dds::DataWriterQos(fast_dds::DATAWRITER_QOS_DEFAULT), lossless);
    names::heartbeat_period(qos.reliable_writer_qos().times) = milliseconds(50);
    names::nack_response_delay(qos.reliable_writer_qos().times) = milliseconds(lossless ? 5 : 1);
    return check(publisher_->create_datawriter(this->topic(topic), qos));
  }
  fast_dds::DataReader* reader(const std::string& topic, bool lossless) {
    auto qos = common(fast_dds::DataReaderQos(fast_dds::DATAREADER_QOS_DEFAULT), lossless);
    names::heartbeat_response_delay(qos.reliable_reader_qos().times) =
        milliseconds(lossless ? 5 : 1);
    fast_dds::DataReader* made = check(subscriber_->create_datareader(this->topic(topic), qos));
    made->get_statuscondition().set_enabled_statuses(fast_dds::StatusMask::data_available());
    return made;
  }

 private:
  template <class T>
  static T* check(T* made) {
    if (made == nullptr) throw std::runtime_error("cannot create a bare endpoint");
    return made;
  }
  fast_dds::Topic* topic(const std::string& name) {
    return check(
        participant_->create_topic(name, "quoin::benchmarks::Bytes", fast_dds::TOPIC_QOS_DEFAULT));
  }
  static names::Duration milliseconds(std::uint32_t count) { return {0, count * 1'000'000U}; }
  // The same limits and timers as the services' presets: both chains keep as much and repeat as
  // soon.
  template <class Qos>
  static Qos common(Qos qos, bool lossless) {
    qos.reliability().kind = fast_dds::RELIABLE_RELIABILITY_QOS;
    qos.reliability().max_blocking_time = names::Duration(1, 0);
    qos.durability().kind = fast_dds::VOLATILE_DURABILITY_QOS;
    qos.history().kind =
        lossless ? fast_dds::KEEP_ALL_HISTORY_QOS : fast_dds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = lossless ? 256 : 32;
    qos.resource_limits().max_instances = 1;
    qos.resource_limits().max_samples = qos.resource_limits().max_samples_per_instance = 256;
    qos.resource_limits().allocated_samples = 1;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return qos;
  }

  fast_dds::DomainParticipant* participant_ = nullptr;
  fast_dds::Publisher* publisher_ = nullptr;
  fast_dds::Subscriber* subscriber_ = nullptr;
};

/// Next message, waiting up to `milliseconds`; false when none came.
inline bool take_bare(fast_dds::DataReader* reader, fast_dds::WaitSet& wait_set, Bytes& bytes,
                      std::uint32_t milliseconds) {
  fast_dds::SampleInfo info;
  fast_dds::ConditionSeq active;
  if (names::succeeded(reader->take_next_sample(&bytes, &info)) && info.valid_data) return true;
  wait_set.wait(active, names::Duration(static_cast<std::int32_t>(milliseconds / 1000),
                                        milliseconds % 1000 * 1'000'000U));
  return names::succeeded(reader->take_next_sample(&bytes, &info)) && info.valid_data;
}

}  // namespace quoin::benchmarks
