// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "services/topics/idl_parser.hpp"

namespace quoin::topics {

/// Eight hexadecimal digits that stand for the fields of a type of `types`: their names, kinds and
/// order, and those of the types inside. What a field may hold (its limits) does not count.
/// Throws std::logic_error for a type that is not there.
[[nodiscard]] std::string digest_of(const IdlTypes& types, std::string_view type);

/// That of a type of idl/, as this program has it; "" for all others. DDS matches types by name
/// alone: two programs that give a type other fields would read each other's bytes wrongly.
[[nodiscard]] std::string_view type_digest(std::string_view dds_type);

}  // namespace quoin::topics
