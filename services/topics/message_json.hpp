// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "services/topics/cdr_codec.hpp"
#include "services/topics/cdr_json.hpp"

namespace quoin::topics {

/// What cdr_to_json makes of the bytes of this message, whose type is of one of the files of idl/.
template <class T>
[[nodiscard]] nlohmann::ordered_json to_json(const T& message) {
  RawMessage raw;
  encode(message, raw);
  return cdr_to_json(type_name<T>(), raw.cdr);
}

}  // namespace quoin::topics
