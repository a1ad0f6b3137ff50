// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_json.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace quoin::topics {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t header_size = 4;  // [byte] encapsulation
constexpr std::size_t deepest_nesting = 32;
constexpr std::size_t most_values = 4'000'000;
// Writers fill the last word up. Beyond that, the bytes are of another type.
constexpr std::size_t most_padding = 3;

/// The double that prints as shortly as the float does.
Json number(float value) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double shortest = 0.0;
  std::from_chars(text.data(), end, shortest);
  return shortest;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

class Walker {
 public:
  Walker(const IdlTypes& types, std::string_view type, std::span<const std::byte> cdr)
      : types_(types), name_(type), cdr_(cdr) {}

  Json walk() {
    const IdlType* type = types_.find(name_);
    if (type == nullptr || type->kind != IdlKind::structure) {
      fail(CdrFault::unknown_type, "the IDL has no such structure");
    }
    read_encapsulation();
    Json message = value(*type, 0);
    if (cdr_.size() - offset_ > most_padding) {
      fail(CdrFault::bytes_left_over,
           std::to_string(cdr_.size() - offset_) + " bytes more than the message has");
    }
    return message;
  }

 private:
  [[noreturn]] void fail(CdrFault fault, const std::string& what) const {
    std::string text = name_ + ": ";
    for (const IdlField* field : path_) text += (field == path_[0] ? "" : ".") + field->name;
    if (!path_.empty()) text += ": ";
    throw CdrError(fault, offset_, text + what + " (byte " + std::to_string(offset_) + ")");
  }

  [[nodiscard]] std::size_t left() const { return cdr_.size() - offset_; }

  void require(std::uint64_t bytes) const {
    if (bytes > left()) {
      fail(CdrFault::truncated,
           std::to_string(bytes) + " bytes needed, " + std::to_string(left()) + " left");
    }
  }

  void read_encapsulation() {
    require(header_size);
    const auto kind = std::pair(std::to_integer<int>(cdr_[0]), std::to_integer<int>(cdr_[1]));
    if (kind.first != 0 || kind.second > 1) {
      fail(CdrFault::unknown_encapsulation, "encapsulation " +
                                                std::to_string(kind.first * 256 + kind.second) +
                                                " is neither CDR_BE (0) nor CDR_LE (1)");
    }
    swapped_ = (kind.second == 1) != (std::endian::native == std::endian::little);
    offset_ = header_size;
  }

  // Alignment counts from the end of the encapsulation header.
  void align(std::size_t size) {
    const std::size_t padding = (size - (offset_ - header_size) % size) % size;
    require(padding);
    offset_ += padding;
  }

  template <class T>
  T primitive() {
    align(sizeof(T));
    require(sizeof(T));
    std::array<std::byte, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), cdr_.data() + offset_, sizeof(T));
    if (swapped_) std::ranges::reverse(bytes);
    offset_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }

  Json boolean() {
    require(1);
    const int value = std::to_integer<int>(cdr_[offset_]);
    if (value > 1) fail(CdrFault::bad_boolean, "a boolean is " + std::to_string(value));
    ++offset_;
    return value == 1;
  }

  Json string(std::size_t bound) {
    const auto length = primitive<std::uint32_t>();  // with the terminating zero
    if (length == 0) return "";  // not by the book, but some write empty strings so
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
    return std::string(begin, length - 1);
  }

  Json enumeration(const IdlType& type) {
    const auto value = primitive<std::uint32_t>();
    if (value < type.enumerators.size()) return type.enumerators[value];
    return value;
  }

  Json list(const IdlType& type, std::uint64_t count, std::size_t depth) {
    // Every value takes a byte at least, so this bounds what is reserved.
    require(count);
    Json values = Json::array();
    values.get_ref<Json::array_t&>().reserve(
        std::min<std::size_t>(count, most_values - std::min(values_, most_values)));
    const IdlType& element = types_.types[type.element];
    for (std::uint64_t i = 0; i < count; ++i) values.push_back(value(element, depth + 1));
    return values;
  }

  Json sequence(const IdlType& type, std::size_t depth) {
    const auto count = primitive<std::uint32_t>();
    if (type.bound != 0 && count > type.bound) {
      fail(CdrFault::beyond_bound, std::to_string(count) + " elements, at most " +
                                       std::to_string(type.bound) + " are allowed");
    }
    return list(type, count, depth);
  }

  Json structure(const IdlType& type, std::size_t depth) {
    Json object = Json::object();
    auto& members = object.get_ref<Json::object_t&>();
    members.reserve(type.fields.size());
    for (const IdlField& field : type.fields) {
      path_.push_back(&field);
      // The parser has seen to it that no name comes twice.
      members.Container::emplace_back(field.name, value(types_.types[field.type], depth + 1));
      path_.pop_back();
    }
    return object;
  }

  Json value(const IdlType& type, std::size_t depth) {
    if (depth > deepest_nesting) fail(CdrFault::nested_too_deeply, "nested too deeply");
    if (++values_ > most_values) fail(CdrFault::too_large, "too many values");
    switch (type.kind) {
      case IdlKind::boolean:
        return boolean();
      case IdlKind::character:
        return std::string(1, primitive<char>());
      case IdlKind::int8:
        return primitive<std::int8_t>();
      case IdlKind::uint8:
        return primitive<std::uint8_t>();
      case IdlKind::int16:
        return primitive<std::int16_t>();
      case IdlKind::uint16:
        return primitive<std::uint16_t>();
      case IdlKind::int32:
        return primitive<std::int32_t>();
      case IdlKind::uint32:
        return primitive<std::uint32_t>();
      case IdlKind::int64:
        return primitive<std::int64_t>();
      case IdlKind::uint64:
        return primitive<std::uint64_t>();
      case IdlKind::float32:
        return number(primitive<float>());
      case IdlKind::float64:
        return number(primitive<double>());
      case IdlKind::string:
        return string(type.bound);
      case IdlKind::sequence:
        return sequence(type, depth);
      case IdlKind::array:
        return list(type, type.bound, depth);
      case IdlKind::enumeration:
        return enumeration(type);
      case IdlKind::structure:
        break;
    }
    return structure(type, depth);
  }

  const IdlTypes& types_;
  std::string name_;
  std::span<const std::byte> cdr_;
  std::size_t offset_ = 0;  // never beyond cdr_.size()
  std::size_t values_ = 0;
  bool swapped_ = false;
  std::vector<const IdlField*> path_;
};

const IdlTypes& types_that_declare(std::string_view dds_type) {
  static const std::vector<IdlTypes> files = [] {
    std::vector<IdlTypes> parsed;
    for (const IdlFile& file : idl_files()) parsed.push_back(parse_idl(file.text));
    return parsed;
  }();
  static const IdlTypes none;
  const auto file = std::ranges::find_if(
      files, [&](const IdlTypes& types) { return types.find(dds_type) != nullptr; });
  return file == files.end() ? none : *file;
}

}  // namespace

Json cdr_to_json(const IdlTypes& types, std::string_view type, std::span<const std::byte> cdr) {
  return Walker(types, type, cdr).walk();
}

Json cdr_to_json(std::string_view dds_type, std::span<const std::byte> cdr) {
  return cdr_to_json(types_that_declare(dds_type), dds_type, cdr);
}

}  // namespace quoin::topics
