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

/// A listener for that participant; see tell_refusals. Also warns of a certificate that ends soon.
[[nodiscard]] std::unique_ptr<eprosima::fastdds::dds::DomainParticipantListener> watch_security(
    const deploy::SecurityConfig& security, const std::string& identity);

}  // namespace quoin::runtime
