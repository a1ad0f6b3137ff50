// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace quoin::deploy {

/// Messages as rows for a spread sheet: one for each element of the first list of structures
/// (corners of Corners, lines of Lines), or one a message where there is none. Every row begins
/// with the stamp, the source and its number.
class MessageTable {
 public:
  /// `message`: as cdr_to_json makes it. Returns the rows, "" behind the last column; the first
  /// call that has any begins with the names of the columns.
  [[nodiscard]] std::vector<std::string> rows(const nlohmann::ordered_json& message);

 private:
  std::vector<std::string> columns_;
};

}  // namespace quoin::deploy
