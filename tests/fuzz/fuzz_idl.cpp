// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any text as IDL, with its own bytes as a message of each of its structures.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/topics/cdr_json.hpp"
#include "services/topics/message_text.hpp"
#include "tests/fuzz/require.hpp"

using namespace quoin::topics;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  IdlTypes idl;
  try {
    idl = parse_idl(text);
  } catch (const IdlError& error) {
    quoin::fuzz::require(error.line() >= 1, "lines count from 1");
    return 0;
  }
  std::vector<std::byte> cdr{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}};
  const auto bytes = std::as_bytes(std::span(data, size));
  cdr.insert(cdr.end(), bytes.begin(), bytes.end());
  for (std::size_t i = 0; i < idl.types.size(); ++i) {
    const IdlType& type = idl.types[i];
    quoin::fuzz::require(type.element <= i, "types refer to types before them");
    for (const IdlField& field : type.fields) {
      quoin::fuzz::require(field.type < i, "types refer to types before them");
    }
    if (type.kind != IdlKind::structure) continue;
    try {
      (void)to_text(type.name, cdr_to_json(idl, type.name, cdr));
    } catch (const CdrError&) {
      continue;
    }
  }
  return 0;
}
