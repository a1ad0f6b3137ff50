// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "sensor_bridge/recordings/json_text.hpp"

#include <algorithm>
#include <optional>

#include "sensor_bridge/excerpt.hpp"
#include "sensor_bridge/number.hpp"

namespace quoin::sensor_bridge {

char JsonText::peek() {
  while (true) {
    at_ = std::min(line_.find_first_not_of(" \t", at_), line_.size());
    if (at_ < line_.size()) return line_[at_];
    if (!lines_.next(line_)) {
      line_ = {};
      at_ = 0;
      return '\0';
    }
    at_ = 0;
  }
}

bool JsonText::skip(char wanted) {
  if (peek() != wanted) return false;
  ++at_;
  return true;
}

void JsonText::expect(char wanted) {
  if (skip(wanted)) return;
  if (peek() == '\0') {
    fail(std::string("the file ends here, before a '") + wanted + "'; it is cut off");
  }
  fail(std::string("'") + wanted + "' is expected, not " + excerpt(line_.substr(at_, 10)));
}

std::string_view JsonText::string() {
  expect('"');
  const std::size_t end = line_.find_first_of("\"\\", at_);
  if (end == std::string_view::npos || line_[end] == '\\') {
    fail("a text without its closing quote, or with an escape, which no scan file has");
  }
  const std::string_view text = line_.substr(at_, end - at_);
  at_ = end + 1;
  return text;
}

double JsonText::number() {
  if (peek() == '\0') fail("the file ends here, before a number; it is cut off");
  const std::size_t end = std::min(line_.find_first_of(" \t,]}:", at_), line_.size());
  const std::string_view text = line_.substr(at_, end - at_);
  const std::optional<double> value = parse_number<double>(text);
  if (!value) fail(excerpt(text) + " is not a number");
  at_ = end;
  return *value;
}

void JsonText::skip_value() {
  int depth = 0;
  do {
    const char next = peek();
    if (next == '\0') fail("the file ends here, inside a value; it is cut off");
    if (next == '"') {
      (void)string();
    } else {
      if (next == '{' || next == '[') ++depth;
      if (next == '}' || next == ']') --depth;
      at_ = next == '{' || next == '[' || next == '}' || next == ']' || next == ',' || next == ':'
                ? at_ + 1
                : std::min(line_.find_first_of(" \t,]}:", at_), line_.size());
    }
  } while (depth > 0);
}

}  // namespace quoin::sensor_bridge
