// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/type_digest.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <stdexcept>

#include "services/topics/topic_types.hpp"

namespace quoin::topics {

namespace {

/// Its fields down to the primitive types, written so that different ones differ.
std::string layout_of(const IdlTypes& types, const IdlType& type) {
  std::string text = std::to_string(static_cast<int>(type.kind));
  switch (type.kind) {
    case IdlKind::sequence:
    case IdlKind::array:
      text += "[" + std::to_string(type.bound) + "]" + layout_of(types, types.types[type.element]);
      break;
    case IdlKind::string:
      text += "[" + std::to_string(type.bound) + "]";
      break;
    case IdlKind::enumeration:
      for (const std::string& enumerator : type.enumerators) text += " " + enumerator;
      break;
    case IdlKind::structure:
      text += "{";
      for (const IdlField& field : type.fields) {
        text += field.name + " " + layout_of(types, types.types[field.type]) + ";";
      }
      text += "}";
      break;
    default:
      break;
  }
  return text;
}

}  // namespace

std::string digest_of(const IdlTypes& types, std::string_view type) {
  const IdlType* const found = types.find(type);
  if (found == nullptr) throw std::logic_error("no type " + std::string(type) + " in the IDL");
  std::uint32_t hash = 2166136261U;  // FNV-1a
  for (const char character : layout_of(types, *found)) {
    hash = (hash ^ static_cast<std::uint8_t>(character)) * 16777619U;
  }
  std::array<char, 9> digits{};
  std::snprintf(digits.data(), digits.size(), "%08x", static_cast<unsigned int>(hash));
  return digits.data();
}

std::string_view type_digest(std::string_view dds_type) {
  static const std::map<std::string, std::string, std::less<>> digests = [] {
    std::map<std::string, std::string, std::less<>> all;
    for (const IdlFile& file : idl_files()) {
      const IdlTypes types = parse_idl(file.text);
      for (const IdlType& type : types.types) {
        if (type.kind != IdlKind::structure || all.contains(type.name)) continue;
        all.emplace(type.name, digest_of(types, type.name));
      }
    }
    return all;
  }();
  const auto found = digests.find(dds_type);
  return found == digests.end() ? std::string_view() : found->second;
}

}  // namespace quoin::topics
