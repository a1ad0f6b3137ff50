// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "services/topics/cdr_cursor.hpp"
#include "services/topics/idl_parser.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {

/// The types of the file of idl/ that declares `dds_type`; none of them when there is no such file.
[[nodiscard]] const IdlTypes& idl_types(std::string_view dds_type);

/// A message with all its fields under the names and in the order of the IDL. `cdr` is a message as
/// it travels, with its encapsulation header; anybody may have sent it. A float becomes the
/// number that prints as shortly as the float does; what JSON cannot express (infinite, not a
/// number) becomes null; an enumeration becomes its name, or its number where the IDL has no name
/// for it; a character becomes a string. Strings are copied as they are: dump them with
/// error_handler_t::replace. Throws CdrError.
[[nodiscard]] nlohmann::ordered_json cdr_to_json(const IdlTypes& types, std::string_view type,
                                                 std::span<const std::byte> cdr);

/// The same for any structure of the files of idl/.
[[nodiscard]] nlohmann::ordered_json cdr_to_json(std::string_view dds_type,
                                                 std::span<const std::byte> cdr);

}  // namespace quoin::topics
