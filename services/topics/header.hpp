// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <idl/Common.h>
#include <string>

namespace quoin::topics {

/// What a message is accounted for as. Of a message without origins, as an external service may
/// send it, one with an empty name.
[[nodiscard]] inline const msg::Origin& origin(const msg::Header& header) {
  static const msg::Origin none;
  return header.origins().empty() ? none : header.origins().front();
}

[[nodiscard]] inline std::uint64_t sequence_number(const msg::Header& header) {
  return origin(header).sequence_number();
}

/// Name of the service that numbered it.
[[nodiscard]] inline const std::string& source(const msg::Header& header) {
  return origin(header).source();
}

/// The only origin of what was measured, or is numbered anew. The header keeps its memory.
inline void set_origin(msg::Header& header, const std::string& source, std::uint64_t incarnation,
                       std::uint64_t sequence_number) {
  header.origins().resize(1);
  msg::Origin& origin = header.origins().front();
  origin.source(source);
  origin.incarnation(incarnation);
  origin.sequence_number(sequence_number);
  origin.part(0);
  origin.parts(1);
}

}  // namespace quoin::topics
