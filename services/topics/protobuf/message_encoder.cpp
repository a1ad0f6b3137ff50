// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/protobuf/message_encoder.hpp"

#include <bit>
#include <google/protobuf/descriptor.h>
#include <stdexcept>
#include <type_traits>

#include "services/topics/cdr_json.hpp"
#include "services/topics/protobuf/schemas.hpp"

namespace quoin::topics {

namespace {

namespace pb = google::protobuf;

static_assert(std::endian::native == std::endian::little, "Protobuf is little-endian");

// Wire types: https://protobuf.dev/programming-guides/encoding/
enum WireType : std::uint32_t { varint = 0, fixed64 = 1, length_delimited = 2, fixed32 = 5 };

constexpr std::size_t deepest_nesting = 32;

void append_varint(std::uint64_t value, std::string& out) {
  for (; value >= 0x80U; value >>= 7U) out.push_back(static_cast<char>(value | 0x80U));
  out.push_back(static_cast<char>(value));
}

void append_tag(std::uint32_t number, WireType type, std::string& out) {
  append_varint((number << 3U) | type, out);
}

/// Puts the length of what was appended since `begin` before it.
void insert_length(std::size_t begin, std::string& out) {
  std::string length;  // ten bytes at most: within the string itself
  append_varint(out.size() - begin, length);
  out.insert(begin, length);
}

/// The Protobuf type of an IDL type that is neither string nor composed; nothing for those that no
/// message on a data topic has.
pb::FieldDescriptor::Type scalar_type(IdlKind kind) {
  switch (kind) {
    case IdlKind::boolean:
      return pb::FieldDescriptor::TYPE_BOOL;
    case IdlKind::int8:
    case IdlKind::int16:
    case IdlKind::int32:
      return pb::FieldDescriptor::TYPE_INT32;
    case IdlKind::uint8:
    case IdlKind::uint16:
    case IdlKind::uint32:
      return pb::FieldDescriptor::TYPE_UINT32;
    case IdlKind::int64:
      return pb::FieldDescriptor::TYPE_INT64;
    case IdlKind::uint64:
      return pb::FieldDescriptor::TYPE_UINT64;
    case IdlKind::float32:
      return pb::FieldDescriptor::TYPE_FLOAT;
    case IdlKind::float64:
      return pb::FieldDescriptor::TYPE_DOUBLE;
    case IdlKind::enumeration:
      return pb::FieldDescriptor::TYPE_ENUM;
    case IdlKind::string:
      return pb::FieldDescriptor::TYPE_STRING;
    case IdlKind::structure:
      return pb::FieldDescriptor::TYPE_MESSAGE;
    case IdlKind::character:
    case IdlKind::sequence:
    case IdlKind::array:
      break;
  }
  throw std::logic_error("no Protobuf type for this type of IDL");
}

template <class T>
constexpr bool is_fixed = std::is_floating_point_v<T>;

template <class T>
void append_scalar(T value, std::string& out) {
  if constexpr (is_fixed<T>) {
    out.append(reinterpret_cast<const char*>(&value), sizeof(T));
  } else {
    // Negative numbers take the ten bytes of a 64-bit one.
    append_varint(static_cast<std::uint64_t>(static_cast<std::int64_t>(value)), out);
  }
}

template <class T>
constexpr WireType wire_type() {
  if constexpr (!is_fixed<T>) return varint;
  return sizeof(T) == 8 ? fixed64 : fixed32;
}

/// Left out is what has no bit set: -0.0 is written.
template <class T>
bool is_default(T value) {
  if constexpr (std::is_same_v<T, double>) return std::bit_cast<std::uint64_t>(value) == 0;
  if constexpr (std::is_same_v<T, float>) return std::bit_cast<std::uint32_t>(value) == 0;
  return value == T{};
}

/// Calls `use` with a value of the C++ type of a number in the CDR; false when it is none.
template <class Use>
bool with_number_of(IdlKind kind, Use&& use) {
  switch (kind) {
    case IdlKind::int8:
      use(std::int8_t{});
      return true;
    case IdlKind::uint8:
      use(std::uint8_t{});
      return true;
    case IdlKind::int16:
      use(std::int16_t{});
      return true;
    case IdlKind::uint16:
      use(std::uint16_t{});
      return true;
    case IdlKind::int32:
      use(std::int32_t{});
      return true;
    case IdlKind::uint32:
    case IdlKind::enumeration:
      use(std::uint32_t{});
      return true;
    case IdlKind::int64:
      use(std::int64_t{});
      return true;
    case IdlKind::uint64:
      use(std::uint64_t{});
      return true;
    case IdlKind::float32:
      use(float{});
      return true;
    case IdlKind::float64:
      use(double{});
      return true;
    default:
      return false;
  }
}

}  // namespace

MessageEncoder::MessageEncoder(std::string_view dds_type)
    : name_(dds_type), types_(idl_types(dds_type)) {
  const IdlType* type = types_.find(dds_type);
  if (type == nullptr || type->kind != IdlKind::structure) {
    throw std::out_of_range("no file of idl/ declares " + name_);
  }
  type_ = static_cast<std::size_t>(type - types_.types.data());
  plans_.resize(types_.types.size());
  plan(type_, protobuf_name(dds_type));
}

void MessageEncoder::plan(std::size_t structure, std::string_view message) {
  const IdlType& type = types_.types[structure];
  const pb::Descriptor& description = protobuf_message(message);
  std::vector<Field> fields;
  for (const IdlField& field : type.fields) {
    const IdlType& declared = types_.types[field.type];
    const bool repeated = declared.kind == IdlKind::sequence || declared.kind == IdlKind::array;
    const std::size_t element = repeated ? declared.element : field.type;
    const IdlType& single = types_.types[element];
    const pb::FieldDescriptor* found = description.FindFieldByName(field.name);
    if (found == nullptr || found->is_repeated() != repeated ||
        found->type() != scalar_type(single.kind)) {
      throw std::logic_error(type.name + "." + field.name + " is not so in the .proto file");
    }
    if (single.kind == IdlKind::structure) plan(element, found->message_type()->full_name());
    fields.push_back({&field, static_cast<std::uint32_t>(found->number())});
  }
  plans_[structure] = std::move(fields);
}

class MessageEncoder::Writer {
 public:
  Writer(const MessageEncoder& encoder, std::span<const std::byte> cdr, std::string& out)
      : encoder_(encoder), cursor_(encoder.name_, cdr), out_(out) {}

  void write() {
    structure(encoder_.type_, 0);
    cursor_.finish();
  }

 private:
  void structure(std::size_t index, std::size_t depth) {
    if (depth > deepest_nesting) cursor_.fail(CdrFault::nested_too_deeply, "nested too deeply");
    for (const Field& field : encoder_.plans_[index]) {
      cursor_.enter(*field.field);
      value(field.field->type, field.number, depth);
      cursor_.leave();
    }
  }

  void value(std::size_t index, std::uint32_t number, std::size_t depth) {
    const IdlType& type = encoder_.types_.types[index];
    switch (type.kind) {
      case IdlKind::sequence:
        return repeated(type.element, cursor_.sequence_length(type.bound), number, depth);
      case IdlKind::array:
        cursor_.require(type.bound);
        return repeated(type.element, type.bound, number, depth);
      case IdlKind::boolean:
        if (cursor_.boolean()) {
          append_tag(number, varint, out_);
          append_varint(1, out_);
        }
        return;
      case IdlKind::string:
        return string(cursor_.string(type.bound), number, false);
      case IdlKind::structure:
        return message(index, number, depth);
      default:
        with_number_of(type.kind, [&](auto zero) {
          const auto read = cursor_.primitive<decltype(zero)>();
          if (is_default(read)) return;
          append_tag(number, wire_type<decltype(zero)>(), out_);
          append_scalar(read, out_);
        });
    }
  }

  void message(std::size_t index, std::uint32_t number, std::size_t depth) {
    append_tag(number, length_delimited, out_);
    const std::size_t begin = out_.size();
    structure(index, depth + 1);
    insert_length(begin, out_);
  }

  void string(std::string_view text, std::uint32_t number, bool element) {
    if (text.empty() && !element) return;
    append_tag(number, length_delimited, out_);
    append_varint(text.size(), out_);
    out_.append(text);
  }

  void repeated(std::size_t element, std::size_t count, std::uint32_t number, std::size_t depth) {
    if (count == 0) return;
    const IdlType& type = encoder_.types_.types[element];
    if (type.kind == IdlKind::structure) {
      for (std::size_t i = 0; i < count; ++i) message(element, number, depth);
      return;
    }
    if (type.kind == IdlKind::string) {
      for (std::size_t i = 0; i < count; ++i) string(cursor_.string(type.bound), number, true);
      return;
    }
    append_tag(number, length_delimited, out_);
    const std::size_t begin = out_.size();
    if (type.kind == IdlKind::boolean) {
      for (std::size_t i = 0; i < count; ++i) out_.push_back(cursor_.boolean() ? '\1' : '\0');
    }
    with_number_of(type.kind, [&](auto zero) {
      using T = decltype(zero);
      if constexpr (is_fixed<T>) {
        cursor_.append_block<T>(count, out_);
      } else {
        for (std::size_t i = 0; i < count; ++i) append_scalar(cursor_.primitive<T>(), out_);
      }
    });
    insert_length(begin, out_);
  }

  const MessageEncoder& encoder_;
  CdrCursor cursor_;
  std::string& out_;
};

void MessageEncoder::encode(std::span<const std::byte> cdr, std::string& out) const {
  Writer(*this, cdr, out).write();
}

}  // namespace quoin::topics
