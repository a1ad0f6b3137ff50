// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

// What Fast DDS 2 and 3 call by different names: those of 3, as far as they say the same.

#if __has_include(<fastrtps/config.h>)
#define QUOIN_FAST_DDS_2

#include <fastcdr/Cdr.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/SerializedPayload.h>
#include <fastdds/rtps/common/Token.h>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/reader/ReaderDiscoveryInfo.h>
#include <fastdds/rtps/resources/TimedEvent.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/config.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/utils/md5.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

namespace quoin::runtime::fast_dds {

namespace rtps = eprosima::fastrtps::rtps;
using Md5 = ::MD5;
using Duration = eprosima::fastrtps::Duration_t;
using DiscoveryProtocol = rtps::DiscoveryProtocol_t;
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;

inline constexpr auto xcdr1 = eprosima::fastcdr::Cdr::DDS_CDR;
inline constexpr auto version = "Fast DDS " FASTRTPS_VERSION_STR;

inline std::size_t size_of(const eprosima::fastcdr::Cdr& cdr) {
  return cdr.getSerializedDataLength();
}
inline bool succeeded(const eprosima::fastrtps::types::ReturnCode_t& code) {
  return code == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
}
inline bool write(eprosima::fastdds::dds::DataWriter& writer, void* sample) {
  return writer.write(sample);
}
template <class Times>
auto& heartbeat_period(Times& times) {
  return times.heartbeatPeriod;
}
template <class Times>
auto& nack_response_delay(Times& times) {
  return times.nackResponseDelay;
}
template <class Times>
auto& heartbeat_response_delay(Times& times) {
  return times.heartbeatResponseDelay;
}

}  // namespace quoin::runtime::fast_dds

#else

#include <fastcdr/Cdr.h>
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/config.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/rtps/attributes/RTPSParticipantAttributes.hpp>
#include <fastdds/rtps/common/InstanceHandle.hpp>
#include <fastdds/rtps/common/SerializedPayload.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#include <fastdds/utils/md5.hpp>

namespace quoin::runtime::fast_dds {

namespace rtps = eprosima::fastdds::rtps;
using Md5 = eprosima::fastdds::MD5;
using Duration = eprosima::fastdds::dds::Duration_t;
using DiscoveryProtocol = rtps::DiscoveryProtocol;
using UdpTransport = rtps::UDPv4TransportDescriptor;

inline constexpr auto xcdr1 = eprosima::fastcdr::CdrVersion::XCDRv1;
inline constexpr auto version = "Fast DDS " FASTDDS_VERSION_STR;

inline std::size_t size_of(const eprosima::fastcdr::Cdr& cdr) {
  return cdr.get_serialized_data_length();
}
inline bool succeeded(eprosima::fastdds::dds::ReturnCode_t code) {
  return code == eprosima::fastdds::dds::RETCODE_OK;
}
inline bool write(eprosima::fastdds::dds::DataWriter& writer, const void* sample) {
  return succeeded(writer.write(sample));
}
template <class Times>
auto& heartbeat_period(Times& times) {
  return times.heartbeat_period;
}
template <class Times>
auto& nack_response_delay(Times& times) {
  return times.nack_response_delay;
}
template <class Times>
auto& heartbeat_response_delay(Times& times) {
  return times.heartbeat_response_delay;
}

}  // namespace quoin::runtime::fast_dds

#endif
