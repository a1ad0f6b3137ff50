// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/topics/idl_parser.hpp"

namespace quoin::topics {

/// Why a message is not used: a field by its path and what is wrong with it, such as
/// "lines.covariance_r: out of range". There are a few of them for a type, whatever is sent.
using Refusal = std::optional<std::string>;

/// Messages that were refused, by reason.
using RefusedCounts = std::map<std::string, std::uint64_t>;

/// The border of a topic type: whether bytes, which anybody may have sent, are a message of the
/// type that keeps what its IDL promises. Looks at the bytes before anything is made of them.
///
/// Without a word of the IDL numbers are finite, sequences have at most 100 000 elements (octets 64
/// MiB), and strings are one line of at most 1024 bytes of printable UTF-8. A comment behind a
/// field says more:
///
///     //@range(a, b) @min(a) @max(b)  the number, or each of the sequence, is in [a, b], which may
///     be inf
///     //@any()                        floating-point numbers need not be finite
///     //@length(n)                    at most n elements, or bytes of a string
///     //@text(n)                      a string of at most n bytes and of several lines
///     //@same_length(f)               as many elements as field f of the same structure
///     //@same_length_or_none(f)       or none
///     //@at_most(f)                   no more than field f has elements
///     //@index_ranges(f)              half-open ranges inside field f, ascending and disjoint
///     //@apart(f)                     index ranges that share nothing with those of f
///     //@covariance(xx, xy, yy)       fields of a positive definite matrix, by columns: a variance
///                                     of 0 says that something is known exactly, which nothing is
///     //@semidefinite(xx, xy, yy)     the same, but 0 where it is not known
class MessageCheck {
 public:
  /// Throws std::logic_error for a type that is not there, and for limits that make no sense.
  MessageCheck(const IdlTypes& types, std::string_view type);

  /// `cdr` begins with its encapsulation header.
  [[nodiscard]] Refusal refusal(std::span<const std::byte> cdr) const;
  /// Of bytes that begin with such a message and go on with something else.
  [[nodiscard]] Refusal refusal_of_beginning(std::span<const std::byte> cdr) const;

 private:
  enum class Rule {
    same_length,
    same_length_or_none,
    at_most,
    index_ranges,
    apart,
    covariance,
    semidefinite
  };
  struct Relation {
    Rule rule;
    std::vector<std::size_t> fields;  // that it belongs to first, where it belongs to one
  };
  struct Field {
    std::string name;
    std::size_t step = 0;
  };
  // How a value is checked.
  struct Step {
    IdlKind kind = IdlKind::boolean;
    double lowest = std::numeric_limits<double>::lowest();
    double highest = std::numeric_limits<double>::max();
    bool any = false;
    bool several_lines = false;
    std::size_t most = 0;     // elements, bytes of a string, enumerators
    std::size_t element = 0;  // of sequences and arrays
    std::vector<Field> fields = {};
    std::vector<Relation> relations = {};
  };
  class Builder;
  template <bool swapped>
  class Walker;

  [[nodiscard]] Refusal check(std::span<const std::byte> cdr, std::size_t most_left) const;

  std::vector<Step> steps_;
  std::size_t root_ = 0;
};

/// Of a row of the table of topic types, of heartbeats, and of the header of them all; null for
/// other types, whose readers look at each field.
[[nodiscard]] const MessageCheck* message_check(std::string_view dds_type);

}  // namespace quoin::topics
