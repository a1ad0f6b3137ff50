// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/topics/cdr_cursor.hpp"

namespace quoin::topics {

/// Makes Protobuf of the messages of one type: every field of the IDL becomes the field of the same
/// name in the .proto file. Bytes go from one encoding to the other without a message in between;
/// what is zero is left out, as proto3 does.
class MessageEncoder {
 public:
  /// `dds_type`: a structure of the files of idl/, such as quoin::msg::Scan. Throws
  /// std::out_of_range when there is no such structure or Protobuf message, and std::logic_error
  /// when a field is missing there or of another type.
  explicit MessageEncoder(std::string_view dds_type);

  /// Appends the Protobuf message to `out`. `cdr` is a message as it travels, with its
  /// encapsulation header; anybody may have sent it. Throws CdrError.
  void encode(std::span<const std::byte> cdr, std::string& out) const;

 private:
  struct Field {
    const IdlField* field;
    std::uint32_t number;  // in the .proto file
  };
  class Writer;

  void plan(std::size_t structure, std::string_view message);

  std::string name_;
  const IdlTypes& types_;
  std::size_t type_;                       // index of the structure
  std::vector<std::vector<Field>> plans_;  // by index of the structure
};

}  // namespace quoin::topics
