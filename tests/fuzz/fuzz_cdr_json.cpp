// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
//
// Any bytes as a message of any type of idl/: the first byte chooses the type.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/topics/cdr_json.hpp"
#include "services/topics/message_text.hpp"
#include "tests/fuzz/require.hpp"

namespace {

using namespace quoin::topics;

const std::vector<std::string>& structures() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const IdlFile& file : idl_files()) {
      for (const IdlType& type : parse_idl(file.text).types) {
        if (type.kind == IdlKind::structure) found.push_back(type.name);
      }
    }
    return found;
  }();
  return names;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string& type = structures()[data[0] % structures().size()];
  const auto bytes = std::as_bytes(std::span(data + 1, size - 1));
  try {
    const nlohmann::ordered_json message = cdr_to_json(type, bytes);
    quoin::fuzz::require(message.is_object(), "a message is an object");
    (void)message.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    (void)to_text(type, message);
  } catch (const CdrError& error) {
    quoin::fuzz::require(error.offset() <= bytes.size(), "an error lies inside the bytes");
  }
  return 0;
}
