// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/runtime/types.hpp"

#include <idl/ControlPubSubTypes.h>
#include <idl/CornersPubSubTypes.h>
#include <idl/LinesPubSubTypes.h>
#include <idl/ScanPubSubTypes.h>
#include <idl/SegmentsPubSubTypes.h>
#include <idl/StatusPubSubTypes.h>

#include "services/runtime/reader_impl.hpp"
#include "services/runtime/writer_impl.hpp"

namespace quoin::runtime {

using eprosima::fastdds::dds::TypeSupport;

template <class T>
Writer<T>::Writer(Participant& participant, const std::string& topic, const TopicQos& qos)
    : WriterBase(std::make_unique<Impl>(participant, topic, type_support<T>(), qos)) {}

template <class T>
Reader<T>::Reader(Participant& participant, const std::string& topic, const TopicQos& qos)
    : ReaderBase(std::make_unique<Impl>(participant, topic, type_support<T>(), qos)) {}

template <>
TypeSupport type_support<msg::Scan>() {
  return TypeSupport(new msg::ScanPubSubType());
}
template <>
TypeSupport type_support<msg::Segments>() {
  return TypeSupport(new msg::SegmentsPubSubType());
}
template <>
TypeSupport type_support<msg::Lines>() {
  return TypeSupport(new msg::LinesPubSubType());
}
template <>
TypeSupport type_support<msg::Corners>() {
  return TypeSupport(new msg::CornersPubSubType());
}
template <>
TypeSupport type_support<msg::ServiceStatus>() {
  return TypeSupport(new msg::ServiceStatusPubSubType());
}
template <>
TypeSupport type_support<msg::ControlRequest>() {
  return TypeSupport(new msg::ControlRequestPubSubType());
}
template <>
TypeSupport type_support<msg::ControlReply>() {
  return TypeSupport(new msg::ControlReplyPubSubType());
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
