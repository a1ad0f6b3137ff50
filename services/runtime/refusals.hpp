// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <fastdds/dds/domain/DomainParticipantListener.hpp>

namespace quoin::runtime {

/// From now on what DDS Security refuses is told in this process's log, a line for each participant
/// and topic, once a minute at most. The listener is for the participant; it knows the others'
/// names, and tells of those whose identity is not signed by `authority` (its common name).
[[nodiscard]] std::unique_ptr<eprosima::fastdds::dds::DomainParticipantListener> tell_refusals(
    const std::string& authority);

}  // namespace quoin::runtime
