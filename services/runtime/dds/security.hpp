// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/discovery.hpp"

namespace quoin::runtime {

/// Turns DDS Security on for the participant `identity`.
void add_security(const SecurityConfig& security, const std::string& identity,
                  eprosima::fastdds::dds::DomainParticipantQos& qos);

/// What that participant, which is called `name`, hears of others; see tell_refusals. Also warns of
/// a certificate that ends soon.
[[nodiscard]] std::unique_ptr<KnownEndpoints> watch_security(const SecurityConfig& security,
                                                             const std::string& identity,
                                                             const std::string& name);

}  // namespace quoin::runtime
