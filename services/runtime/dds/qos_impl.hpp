// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "services/runtime/dds/participant.hpp"
#include "services/runtime/dds/qos.hpp"

namespace quoin::runtime {

[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicQos& topic);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos(const TopicQos& topic);

/// Discovery asks the ports of this many participants on a host; the port formula of the RTPS
/// standard has room for 119 in a domain.
inline constexpr std::uint32_t max_participants = 100;

/// Transport and discovery of a participant that uses the interfaces of these `addresses` and no
/// others. Throws DeploymentError when it is to be a discovery server at another address.
[[nodiscard]] eprosima::fastdds::dds::DomainParticipantQos network_qos(
    const ParticipantConfig& config, const std::vector<std::string>& addresses);

}  // namespace quoin::runtime
