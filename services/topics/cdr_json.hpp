// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "services/topics/idl_parser.hpp"
#include "services/topics/topic_types.hpp"

namespace quoin::topics {

enum class CdrFault {
  unknown_type,           ///< the IDL declares no structure of this name
  unknown_encapsulation,  ///< not plain CDR (XCDR1) of either byte order
  truncated,              ///< the bytes end before the message, or a length goes beyond them
  string_not_terminated,  ///< a string does not end with its zero
  bad_boolean,            ///< neither 0 nor 1
  beyond_bound,           ///< a sequence or string is longer than the IDL allows
  nested_too_deeply,      ///< more than 32 structures, sequences and arrays in each other
  too_large,              ///< more than four million values
  bytes_left_over         ///< more bytes than the message and its padding: it is of another type
};

/// Why bytes are not a message of the type. what() names type, field, fault and offset.
class CdrError : public std::runtime_error {
 public:
  CdrError(CdrFault fault, std::size_t offset, const std::string& what)
      : std::runtime_error(what), fault_(fault), offset_(offset) {}
  [[nodiscard]] CdrFault fault() const { return fault_; }
  /// [byte] of the first byte that is wrong or missing, from the start of the encapsulation header
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  CdrFault fault_;
  std::size_t offset_;
};

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
