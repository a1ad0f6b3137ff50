// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "services/runtime/dds/discovery.hpp"

namespace quoin::runtime {

/// From now on what DDS Security refuses is told in this process's log, a line for each participant
/// and topic, once a minute at most. What is returned listens for the participant called
/// `own_name`, and tells of those whose identity is not signed by `authority` (its common name).
[[nodiscard]] std::unique_ptr<KnownEndpoints> tell_refusals(const std::string& own_name,
                                                            const std::string& authority);

}  // namespace quoin::runtime
