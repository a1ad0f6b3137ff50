// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <idl/Common.h>
#include <string>
#include <string_view>
#include <vector>

namespace eprosima::fastcdr {
class Cdr;
}

namespace quoin::topics {

/// A message of any type as it travels.
struct RawMessage {
  /// XCDR1 of either byte order, behind its encapsulation header of four bytes.
  std::vector<std::byte> cdr;
  /// [ns since the Unix epoch] by the clock of the host that wrote it; 0 when it was not received.
  std::int64_t published = 0;
  /// [ns since the Unix epoch] by the clock of this host; 0 when it was not received.
  std::int64_t received = 0;
};

/// What the generated code of an IDL type does, for those who do not know the type. The pointers
/// are to messages of that type.
struct CdrCodec {
  std::string type_name;     ///< as DDS has it: "quoin::msg::Scan"
  bool keyed = false;        ///< some fields are its key
  std::size_t key_size = 0;  ///< [byte] most that a key takes, as the generated code sees it
  std::size_t (*size)(const void* message) = nullptr;  ///< [byte] without encapsulation header
  void (*serialize)(const void* message, eprosima::fastcdr::Cdr& cdr) = nullptr;
  void (*serialize_key)(const void* message, eprosima::fastcdr::Cdr& cdr) = nullptr;
  void (*deserialize)(void* message, eprosima::fastcdr::Cdr& cdr) = nullptr;
  void* (*create)() = nullptr;
  void (*destroy)(void* message) = nullptr;
};

/// Full name of a C++ type, which is that of the IDL type that it was made of.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
  // GCC ends the type with ';' or ']', clang with ']'.
  const std::string_view function = __PRETTY_FUNCTION__;
  const std::string_view before = "T = ";
  const std::size_t begin = function.find(before) + before.size();
  return function.substr(begin, function.find_first_of(";]", begin) - begin);
}

/// The codec of a type that was generated of an IDL file. Only this and the header of the type need
/// to be there, so that a new type needs no line anywhere.
template <class T>
[[nodiscard]] const CdrCodec& cdr_codec() {
  using Cdr = eprosima::fastcdr::Cdr;
  static const CdrCodec codec{
      .type_name = std::string(type_name<T>()),
      .keyed = T::isKeyDefined(),
      .key_size = T::getKeyMaxCdrSerializedSize(),
      .size = [](const void* m) { return T::getCdrSerializedSize(*static_cast<const T*>(m)); },
      .serialize = [](const void* m, Cdr& cdr) { static_cast<const T*>(m)->serialize(cdr); },
      .serialize_key = [](const void* m, Cdr& cdr) { static_cast<const T*>(m)->serializeKey(cdr); },
      .deserialize = [](void* m, Cdr& cdr) { static_cast<T*>(m)->deserialize(cdr); },
      .create = []() -> void* { return new T(); },
      .destroy = [](void* m) { delete static_cast<T*>(m); }};
  return codec;
}

/// The codec of a structure of idl/ that has a key, without which nobody can read or write its
/// topics, not even raw; null for all others. A new type with a key is a row of it.
[[nodiscard]] const CdrCodec* keyed_codec(std::string_view dds_type);

/// [byte] What `encode` writes: with encapsulation header, filled up to a multiple of four.
[[nodiscard]] std::size_t encoded_size(const CdrCodec& codec, const void* message);
/// Writes `encoded_size` bytes in the byte order of this machine. The number of bytes; 0 when they
/// are more than `capacity` or the message cannot be expressed.
[[nodiscard]] std::size_t encode(const CdrCodec& codec, const void* message, std::byte* cdr,
                                 std::size_t capacity);
/// False when the bytes are no such message; then some of its fields may have been read.
[[nodiscard]] bool decode(const CdrCodec& codec, const std::byte* cdr, std::size_t size,
                          void* message);

/// Whether the bytes begin as plain CDR (XCDR1) does.
[[nodiscard]] bool is_plain_cdr(const std::byte* cdr, std::size_t size);

/// Only the bytes of `raw` are set, whose memory is reused.
template <class T>
void encode(const T& message, RawMessage& raw) {
  raw.cdr.resize(encoded_size(cdr_codec<T>(), &message));
  raw.cdr.resize(encode(cdr_codec<T>(), &message, raw.cdr.data(), raw.cdr.size()));
}

/// The memory of `message` is reused. False when the bytes, which anybody may have sent, are no
/// such message; then some of its fields may have been read.
template <class T>
[[nodiscard]] bool decode(const RawMessage& raw, T& message) {
  return decode(cdr_codec<T>(), raw.cdr.data(), raw.cdr.size(), &message);
}

/// The header that any of our messages on data topics begins with, without the rest. False when the
/// bytes, which anybody may have sent, are no header as its IDL promises it; those of another type
/// may pass for one.
[[nodiscard]] bool read_header(const RawMessage& raw, msg::Header& header);

}  // namespace quoin::topics
