// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/discovery.hpp"

namespace quoin::runtime {

/// From now on what DDS Security refuses is reported in this process's log, a line for each
/// participant and topic, once a minute at most. What is returned listens for the participant
/// called `own_name`, and reports those whose identity is not signed by `authority` (its common
/// name).
[[nodiscard]] std::unique_ptr<KnownEndpoints> tell_refusals(const std::string& own_name,
                                                            const std::string& authority);

/// Turns DDS Security on for the participant `identity`.
void add_security(const SecurityConfig& security, const std::string& identity,
                  eprosima::fastdds::dds::DomainParticipantQos& qos);

/// What that participant, which is called `name`, hears of others; see tell_refusals. Also warns of
/// a certificate that ends soon.
[[nodiscard]] std::unique_ptr<KnownEndpoints> watch_security(const SecurityConfig& security,
                                                             const std::string& identity,
                                                             const std::string& name);

}  // namespace quoin::runtime
