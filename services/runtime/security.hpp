// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "deploy/deployment/deployment.hpp"

namespace quoin::runtime {

/// Turns DDS Security on for the participant `identity`.
void add_security(const deploy::SecurityConfig& security, const std::string& identity,
                  eprosima::fastdds::dds::DomainParticipantQos& qos);

/// From now on what DDS Security refuses is told in the log of this process; the listener, which
/// the participant is to have, names those who are refused.
[[nodiscard]] std::unique_ptr<eprosima::fastdds::dds::DomainParticipantListener> tell_refusals();

}  // namespace quoin::runtime
