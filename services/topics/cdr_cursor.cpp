// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_cursor.hpp"

namespace quoin::topics {

namespace {

constexpr std::size_t header_size = 4;  // [byte] encapsulation
// Writers fill the last word up. Beyond that, the bytes are of another type.
constexpr std::size_t most_padding = 3;

}  // namespace

CdrCursor::CdrCursor(std::string_view type, std::span<const std::byte> cdr)
    : type_(type), cdr_(cdr) {
  require(header_size);
  const int first = std::to_integer<int>(cdr_[0]);
  const int second = std::to_integer<int>(cdr_[1]);
  if (first != 0 || second > 1) {
    fail(CdrFault::unknown_encapsulation, "encapsulation " + std::to_string(first * 256 + second) +
                                              " is neither CDR_BE (0) nor CDR_LE (1)");
  }
  swapped_ = (second == 1) != (std::endian::native == std::endian::little);
  offset_ = header_size;
}

void CdrCursor::fail(CdrFault fault, const std::string& what) const {
  std::string text = std::string(type_) + ": ";
  for (std::size_t i = 0; i < path_.size(); ++i) text += (i == 0 ? "" : ".") + path_[i]->name;
  if (!path_.empty()) text += ": ";
  throw CdrError(fault, offset_, text + what + " (byte " + std::to_string(offset_) + ")");
}

void CdrCursor::require(std::uint64_t count) const {
  const std::size_t left = cdr_.size() - offset_;
  if (count > left) {
    fail(CdrFault::truncated,
         std::to_string(count) + " bytes needed, " + std::to_string(left) + " left");
  }
}

// Alignment counts from the end of the encapsulation header.
void CdrCursor::align(std::size_t size) {
  const std::size_t padding = (size - (offset_ - header_size) % size) % size;
  require(padding);
  offset_ += padding;
}

bool CdrCursor::boolean() {
  require(1);
  const int value = std::to_integer<int>(cdr_[offset_]);
  if (value > 1) fail(CdrFault::bad_boolean, "a boolean is " + std::to_string(value));
  ++offset_;
  return value == 1;
}

std::string_view CdrCursor::string(std::size_t bound) {
  const auto length = primitive<std::uint32_t>();  // with the terminating zero
  if (length == 0) return {};  // not by the book, but some write empty strings so
  require(length);
  if (bound != 0 && length - 1 > bound) {
    fail(CdrFault::beyond_bound, std::to_string(length - 1) + " characters, at most " +
                                     std::to_string(bound) + " are allowed");
  }
  const auto* begin = reinterpret_cast<const char*>(cdr_.data() + offset_);
  if (begin[length - 1] != '\0') {
    fail(CdrFault::string_not_terminated,
         "a string of " + std::to_string(length) + " bytes does not end with a zero");
  }
  offset_ += length;
  return {begin, length - 1};
}

std::size_t CdrCursor::sequence_length(std::size_t bound) {
  const auto count = primitive<std::uint32_t>();
  if (bound != 0 && count > bound) {
    fail(CdrFault::beyond_bound,
         std::to_string(count) + " elements, at most " + std::to_string(bound) + " are allowed");
  }
  require(count);
  return count;
}

void CdrCursor::finish() const {
  const std::size_t left = cdr_.size() - offset_;
  if (left > most_padding) {
    fail(CdrFault::bytes_left_over, std::to_string(left) + " bytes more than the message has");
  }
}

}  // namespace quoin::topics
