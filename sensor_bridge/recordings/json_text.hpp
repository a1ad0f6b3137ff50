// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "sensor_bridge/recordings/line_reader.hpp"

namespace quoin::sensor_bridge {

/// JSON of any size, token by token; never the whole file in memory. Errors name line and column.
class JsonText {
 public:
  explicit JsonText(LineReader& lines) : lines_(lines) {}

  /// The next character that is no blank, without taking it; '\0' at the end of the file.
  char peek();
  /// Takes that character if it is this one.
  bool skip(char wanted);
  /// Takes it, or throws ScanFileError.
  void expect(char wanted);
  /// A string without escapes, valid until the next token. Throws ScanFileError.
  std::string_view string();
  /// Throws ScanFileError.
  double number();
  /// Any value, however deep. Throws ScanFileError.
  void skip_value();

  /// Throws ScanFileError for the place of the next token.
  [[noreturn]] void fail(const std::string& what) const { lines_.fail(at_, what); }

 private:
  LineReader& lines_;
  std::string_view line_;
  std::size_t at_ = 0;
};

}  // namespace quoin::sensor_bridge
