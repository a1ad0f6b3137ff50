// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/dds/types.hpp"

#include <cstdint>
#include <functional>
#include <idl/ControlPubSubTypes.h>
#include <idl/CornersPubSubTypes.h>
#include <idl/LinesPubSubTypes.h>
#include <idl/ScanPubSubTypes.h>
#include <idl/SegmentsPubSubTypes.h>
#include <idl/StatusPubSubTypes.h>

#include "services/runtime/dds/reader_impl.hpp"
#include "services/runtime/dds/writer_impl.hpp"

namespace quoin::runtime {

using eprosima::fastdds::dds::TypeSupport;
using eprosima::fastrtps::rtps::SerializedPayload_t;

namespace {

// [byte] What a place of a history has at first; it grows with the samples that it holds. The
// generated code would have it hold a hundred elements of every sequence, and 255 characters of
// every string: 66 kB for the corners of a scan, of which a room needs 2.
constexpr std::uint32_t smallest_sample = 512;

/// A generated type, put right.
template <class Generated>
class Type : public Generated {
 public:
  Type() {
    // With type propagation on, nested types crash Fast DDS 2.9's discovery server and Cyclone DDS
    // refuses to match.
    this->auto_fill_type_information(false);
    this->auto_fill_type_object(false);
    this->m_typeSize = smallest_sample;
  }

  // Of samples that are signed but not encrypted Fast DDS 2.9 loses those that do not end at a
  // multiple of four bytes.
  bool serialize(void* data, SerializedPayload_t* payload) override {
    if (!Generated::serialize(data, payload)) return false;
    for (; payload->length % 4 != 0; ++payload->length) {
      if (payload->length >= payload->max_size) return false;
      payload->data[payload->length] = 0;
    }
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [size = Generated::getSerializedSizeProvider(data)] { return (size() + 3U) & ~3U; };
  }
};

}  // namespace

template <class T>
Writer<T>::Writer(Participant& participant, const std::string& topic, const TopicQos& qos)
    : WriterBase(std::make_unique<Impl>(participant, topic, type_support<T>(), qos)) {}

template <class T>
Reader<T>::Reader(Participant& participant, const std::string& topic, const TopicQos& qos)
    : ReaderBase(std::make_unique<Impl>(participant, topic, type_support<T>(), qos)) {}

template <>
TypeSupport type_support<msg::Scan>() {
  return TypeSupport(new Type<msg::ScanPubSubType>());
}
template <>
TypeSupport type_support<msg::Segments>() {
  return TypeSupport(new Type<msg::SegmentsPubSubType>());
}
template <>
TypeSupport type_support<msg::Lines>() {
  return TypeSupport(new Type<msg::LinesPubSubType>());
}
template <>
TypeSupport type_support<msg::Corners>() {
  return TypeSupport(new Type<msg::CornersPubSubType>());
}
template <>
TypeSupport type_support<msg::ServiceStatus>() {
  return TypeSupport(new Type<msg::ServiceStatusPubSubType>());
}
template <>
TypeSupport type_support<msg::ControlRequest>() {
  return TypeSupport(new Type<msg::ControlRequestPubSubType>());
}
template <>
TypeSupport type_support<msg::ControlReply>() {
  return TypeSupport(new Type<msg::ControlReplyPubSubType>());
}

// Every topic type, for both directions; a new type is one line here and one above.
template class Writer<msg::Scan>;
template class Writer<msg::Segments>;
template class Writer<msg::Lines>;
template class Writer<msg::Corners>;
template class Writer<msg::ServiceStatus>;
template class Writer<msg::ControlRequest>;
template class Writer<msg::ControlReply>;
template class Reader<msg::Scan>;
template class Reader<msg::Segments>;
template class Reader<msg::Lines>;
template class Reader<msg::Corners>;
template class Reader<msg::ServiceStatus>;
template class Reader<msg::ControlRequest>;
template class Reader<msg::ControlReply>;

}  // namespace quoin::runtime
