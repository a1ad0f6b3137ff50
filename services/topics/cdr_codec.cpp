// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_codec.hpp"

#include <cstring>
#include <exception>
#include <idl/LineMap.h>
#include <idl/Status.h>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/config.h>

#include "services/topics/message_check.hpp"

namespace quoin::topics {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

namespace {

constexpr std::size_t header_size = 4;  // [byte] encapsulation

// Fast CDR 1 comes with Fast DDS 2, Fast CDR 2 with 3.
#if FASTCDR_VERSION_MAJOR < 2
constexpr auto xcdr1 = Cdr::DDS_CDR;
std::size_t size_of(const Cdr& cdr) { return cdr.getSerializedDataLength(); }
bool is_whole(const CdrCodec&, const void*, std::size_t) { return true; }
#else
constexpr auto xcdr1 = eprosima::fastcdr::CdrVersion::XCDRv1;
std::size_t size_of(const Cdr& cdr) { return cdr.get_serialized_data_length(); }
// What ends behind any of its members passes for whole with version 2: the others stay as they are.
bool is_whole(const CdrCodec& codec, const void* message, std::size_t size) {
  return header_size + codec.size(message) <= size;
}
#endif

}  // namespace

const CdrCodec* keyed_codec(std::string_view dds_type) {
  for (const CdrCodec* codec : {&cdr_codec<msg::LineMap>(), &cdr_codec<msg::ServiceStatus>()}) {
    if (codec->type_name == dds_type) return codec;
  }
  return nullptr;
}

std::size_t encoded_size(const CdrCodec& codec, const void* message) {
  // Of samples that are signed but not encrypted Fast DDS 2.9 loses those that do not end at a
  // multiple of four bytes.
  return (header_size + codec.size(message) + 3U) & ~std::size_t{3};
}

std::size_t encode(const CdrCodec& codec, const void* message, std::byte* cdr,
                   std::size_t capacity) {
  FastBuffer buffer(reinterpret_cast<char*>(cdr), capacity);
  Cdr out(buffer, Cdr::DEFAULT_ENDIAN, xcdr1);
  try {
    out.serialize_encapsulation();
    codec.serialize(message, out);
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return 0;
  }
  std::size_t size = size_of(out);
  for (; size % 4 != 0; ++size) {
    if (size >= capacity) return 0;
    cdr[size] = std::byte{0};
  }
  return size;
}

bool is_plain_cdr(const std::byte* cdr, std::size_t size) {
  return size >= header_size && cdr[0] == std::byte{0} && cdr[1] <= std::byte{1};
}

bool decode(const CdrCodec& codec, const std::byte* cdr, std::size_t size, void* message) {
  if (!is_plain_cdr(cdr, size)) return false;
  // fastcdr only reads, but wants bytes that it could write.
  FastBuffer buffer(const_cast<char*>(reinterpret_cast<const char*>(cdr)), size);
  Cdr in(buffer, Cdr::DEFAULT_ENDIAN, xcdr1);
  try {
    in.read_encapsulation();
    codec.deserialize(message, in);
    return is_whole(codec, message, size);
  } catch (const std::exception&) {  // of fastcdr, or lengths that no memory is there for
    return false;
  }
}

bool read_header(const RawMessage& raw, msg::Header& header) {
  static const MessageCheck& check = *message_check(type_name<msg::Header>());
  return !check.refusal_of_beginning(raw.cdr) && decode(raw, header);
}

}  // namespace quoin::topics
