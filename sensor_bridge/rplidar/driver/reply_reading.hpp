// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "sensor_bridge/rplidar/driver/diagnosis.hpp"
#include "sensor_bridge/rplidar/protocol/descriptor.hpp"
#include "sensor_bridge/rplidar/protocol/request.hpp"

namespace quoin::sensor_bridge::rplidar {

/// False for an answer to an earlier question about the configuration.
[[nodiscard]] bool answers(const Request& request, std::span<const std::uint8_t> payload);

/// Why there is no answer of that type in what was heard behind a request. `spoke_before`: bytes
/// had arrived before.
[[nodiscard]] Diagnosis diagnose_reply(const Request& request, AnswerType type,
                                       std::span<const std::uint8_t> heard, bool spoke_before);

/// For an answer that cannot be meant.
[[nodiscard]] Diagnosis wrong_value(const std::string& name, const std::string& value);

/// Such as "24 47 50 ...".
[[nodiscard]] std::string hexadecimal(std::span<const std::uint8_t> bytes);

}  // namespace quoin::sensor_bridge::rplidar
