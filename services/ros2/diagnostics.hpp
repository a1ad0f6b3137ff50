// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Status.h>

#include "services/ros2/messages.hpp"

namespace quoin::ros2 {

// Levels of diagnostic_msgs/DiagnosticStatus.
inline constexpr std::uint8_t level_ok = 0;
inline constexpr std::uint8_t level_warn = 1;
inline constexpr std::uint8_t level_error = 2;
inline constexpr std::uint8_t level_stale = 3;

/// A heartbeat of a service that is `age` [ns] old: an error when the service failed, stale after
/// three seconds, a warning when something is lost, waited for or does not fit.
void fill_diagnostic(const msg::ServiceStatus& in, std::int64_t age, std::string_view name_space,
                     DiagnosticStatus& out);

}  // namespace quoin::ros2
