// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/cdr_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <vector>

#include <nlohmann/json.hpp>

namespace quoin::topics {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t deepest_nesting = 32;
constexpr std::size_t most_values = 4'000'000;

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
  Walker(const IdlTypes& types, const std::string& type, std::span<const std::byte> cdr)
      : types_(types), cursor_(type, cdr) {}

  Json walk(const IdlType& type) {
    Json message = value(type, 0);
    cursor_.finish();
    return message;
  }

 private:
  Json enumeration(const IdlType& type) {
    const auto value = cursor_.primitive<std::uint32_t>();
    if (value < type.enumerators.size()) return type.enumerators[value];
    return value;
  }

  Json list(const IdlType& type, std::uint64_t count, std::size_t depth) {
    // Every value takes a byte at least, so this bounds what is reserved.
    cursor_.require(count);
    Json values = Json::array();
    values.get_ref<Json::array_t&>().reserve(
        std::min<std::size_t>(count, most_values - std::min(values_, most_values)));
    const IdlType& element = types_.types[type.element];
    for (std::uint64_t i = 0; i < count; ++i) values.push_back(value(element, depth + 1));
    return values;
  }

  Json structure(const IdlType& type, std::size_t depth) {
    Json object = Json::object();
    auto& members = object.get_ref<Json::object_t&>();
    members.reserve(type.fields.size());
    for (const IdlField& field : type.fields) {
      cursor_.enter(field);
      // The parser has seen to it that no name comes twice.
      members.Container::emplace_back(field.name, value(types_.types[field.type], depth + 1));
      cursor_.leave();
    }
    return object;
  }

  Json value(const IdlType& type, std::size_t depth) {
    if (depth > deepest_nesting) cursor_.fail(CdrFault::nested_too_deeply, "nested too deeply");
    if (++values_ > most_values) cursor_.fail(CdrFault::too_large, "too many values");
    switch (type.kind) {
      case IdlKind::boolean:
        return cursor_.boolean();
      case IdlKind::character:
        return std::string(1, cursor_.primitive<char>());
      case IdlKind::int8:
        return cursor_.primitive<std::int8_t>();
      case IdlKind::uint8:
        return cursor_.primitive<std::uint8_t>();
      case IdlKind::int16:
        return cursor_.primitive<std::int16_t>();
      case IdlKind::uint16:
        return cursor_.primitive<std::uint16_t>();
      case IdlKind::int32:
        return cursor_.primitive<std::int32_t>();
      case IdlKind::uint32:
        return cursor_.primitive<std::uint32_t>();
      case IdlKind::int64:
        return cursor_.primitive<std::int64_t>();
      case IdlKind::uint64:
        return cursor_.primitive<std::uint64_t>();
      case IdlKind::float32:
        return number(cursor_.primitive<float>());
      case IdlKind::float64:
        return number(cursor_.primitive<double>());
      case IdlKind::string:
        return std::string(cursor_.string(type.bound));
      case IdlKind::sequence:
        return list(type, cursor_.sequence_length(type.bound), depth);
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
  CdrCursor cursor_;
  std::size_t values_ = 0;
};

}  // namespace

const IdlTypes& idl_types(std::string_view dds_type) {
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

Json cdr_to_json(const IdlTypes& types, std::string_view type, std::span<const std::byte> cdr) {
  const std::string name(type);
  const IdlType* found = types.find(type);
  if (found == nullptr || found->kind != IdlKind::structure) {
    throw CdrError(CdrFault::unknown_type, 0, name + ": the IDL has no such structure (byte 0)");
  }
  return Walker(types, name, cdr).walk(*found);
}

Json cdr_to_json(std::string_view dds_type, std::span<const std::byte> cdr) {
  return cdr_to_json(idl_types(dds_type), dds_type, cdr);
}

}  // namespace quoin::topics
