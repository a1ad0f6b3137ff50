// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "services/topics/idl_parser.hpp"

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

/// Reads the values of a message as it travels, one after the other. Anybody may have sent it:
/// every read is checked, and throws CdrError where the bytes are no such value.
class CdrCursor {
 public:
  /// `type`: what errors call the message. `cdr` begins with the encapsulation header.
  CdrCursor(std::string_view type, std::span<const std::byte> cdr);

  /// Names the field that is read now, in errors; leave() when it is done.
  void enter(const IdlField& field) { path_.push_back(&field); }
  void leave() { path_.pop_back(); }

  template <class T>
  [[nodiscard]] T primitive() {
    align(sizeof(T));
    require(sizeof(T));
    T value{};
    std::memcpy(&value, cdr_.data() + offset_, sizeof(T));
    offset_ += sizeof(T);
    return swapped_ ? swapped(value) : value;
  }
  [[nodiscard]] bool boolean();
  /// Without the terminating zero; `bound` 0: any length. Valid as long as the bytes are.
  [[nodiscard]] std::string_view string(std::size_t bound);
  /// Number of elements of a sequence, of which each takes a byte at least.
  [[nodiscard]] std::size_t sequence_length(std::size_t bound);
  /// `count` values of T. Appends their bytes, in the order of this machine, to `out`.
  template <class T>
  void append_block(std::size_t count, std::string& out) {
    if (count == 0) return;
    align(sizeof(T));
    require(std::uint64_t{count} * sizeof(T));
    const auto* begin = reinterpret_cast<const char*>(cdr_.data() + offset_);
    if (!swapped_) {
      out.append(begin, count * sizeof(T));
      offset_ += count * sizeof(T);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const T value = primitive<T>();
      out.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
  }
  /// Every value takes a byte at least: whether `count` of them can follow.
  void require(std::uint64_t count) const;
  /// After the last value: only padding may follow.
  void finish() const;

  [[noreturn]] void fail(CdrFault fault, const std::string& what) const;

 private:
  template <class T>
  [[nodiscard]] static T swapped(T value) {
    auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
    std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }
  void align(std::size_t size);

  std::string_view type_;
  std::span<const std::byte> cdr_;
  std::size_t offset_ = 0;  // never beyond cdr_.size()
  bool swapped_ = false;
  std::vector<const IdlField*> path_;
};

}  // namespace quoin::topics
