// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace quoin::topics {

/// One line for people: origin and stamp, time since the source published, content. `message` is
/// what cdr_to_json gives for `dds_type`. A type without a text of its own, or another version of
/// it, is shown by its single values and the lengths of its sequences. What is not
/// printable is escaped.
[[nodiscard]] std::string to_text(std::string_view dds_type, const nlohmann::ordered_json& message);

}  // namespace quoin::topics
