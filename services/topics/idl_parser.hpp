// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::topics {

enum class IdlKind {
  boolean,
  character,
  int8,
  uint8,  // octet, too
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  string,
  sequence,
  array,
  enumeration,
  structure
};

/// What a comment behind a field says of its values: @range(0, 1) is {"range", {"0", "1"}}.
struct IdlLimit {
  std::string name;
  std::vector<std::string> arguments;
};

struct IdlField {
  std::string name;
  std::size_t type = 0;  ///< index into IdlTypes::types
  std::vector<IdlLimit> limits = {};
};

struct IdlType {
  IdlKind kind = IdlKind::boolean;
  std::string name = {};                      ///< of enumerations and structures, with modules
  std::size_t element = 0;                    ///< of sequences and arrays: index of their type
  std::size_t bound = 0;                      ///< elements of an array; most of a sequence, 0: any
  std::vector<IdlField> fields = {};          ///< of structures, at least one
  std::vector<std::string> enumerators = {};  ///< by value, at least one
};

/// The types of an IDL text. A type refers only to types before it.
struct IdlTypes {
  std::vector<IdlType> types;

  /// Structure or enumeration of this full name, such as quoin::msg::Scan; null when there is none.
  [[nodiscard]] const IdlType* find(std::string_view name) const;
};

/// What an IDL text has that this parser does not know, or that is wrong with it.
class IdlError : public std::runtime_error {
 public:
  IdlError(std::size_t line, const std::string& what)
      : std::runtime_error("line " + std::to_string(line) + ": " + what), line_(line) {}
  [[nodiscard]] std::size_t line() const { return line_; }  ///< from 1

 private:
  std::size_t line_;
};

/// Reads modules, structures and enumerations of primitive types, strings, sequences and arrays,
/// without #include (idl_text resolves them), typedef, const, union or wide characters. Annotations
/// are ignored; one that would change what is sent (such as @optional) is an error. So are
/// comments, but for limits behind a field, in the form that DDS-XTypes 1.3 (7.3.1.2.3) has for
/// tools that do not know an annotation: //@name(argument, ...) @name(...) and whatever follows.
/// Throws IdlError.
[[nodiscard]] IdlTypes parse_idl(std::string_view text);

}  // namespace quoin::topics
