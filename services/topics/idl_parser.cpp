// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/topics/idl_parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace quoin::topics {

namespace {

constexpr std::size_t deepest_declaration = 16;  // of modules, and of sequences
constexpr std::size_t most_types = 10'000;  // fields included; a recording may come from anybody

// Annotations that change nothing of what is sent.
constexpr std::array<std::string_view, 10> ignored_annotations{
    "final", "key", "topic", "nested", "id", "unit", "min", "max", "range", "default"};

bool starts_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Token {
  std::string_view text;  // empty at the end
  std::size_t line = 1;
};

class Lexer {
 public:
  explicit Lexer(std::string_view text) : rest_(text) {}

  Token next() {
    limits_ = {};
    skip_blanks_and_comments();
    if (rest_.empty()) return {{}, line_};
    std::size_t length = 1;
    if (starts_name(rest_[0]) || is_digit(rest_[0])) {
      while (length < rest_.size() && (starts_name(rest_[length]) || is_digit(rest_[length]))) {
        ++length;
      }
    } else if (rest_.starts_with("::")) {
      length = 2;
    } else if (rest_[0] == '"') {
      const std::size_t end = rest_.find_first_of("\"\n", 1);
      if (end == std::string_view::npos || rest_[end] == '\n') {
        throw IdlError(line_, "a string is not closed");
      }
      length = end + 1;
    }
    return {take(length), line_};
  }

  /// What stands behind the //@ of the line on which the last token began to be looked for.
  [[nodiscard]] std::string_view limits() const { return limits_; }

 private:
  std::string_view take(std::size_t length) {
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(taken.size());
    return taken;
  }

  void skip_blanks_and_comments() {
    const std::size_t first_line = line_;
    while (!rest_.empty()) {
      if (rest_[0] == '\n') {
        ++line_;
        take(1);
      } else if (rest_[0] == ' ' || rest_[0] == '\t' || rest_[0] == '\r') {
        take(1);
      } else if (rest_.starts_with("//")) {
        const std::string_view comment = take(std::min(rest_.find('\n'), rest_.size()));
        if (comment.starts_with("//@") && line_ == first_line) limits_ = comment.substr(2);
      } else if (rest_.starts_with("/*")) {
        const std::size_t end = rest_.find("*/", 2);
        if (end == std::string_view::npos) throw IdlError(line_, "a comment is not closed");
        const std::string_view comment = take(end + 2);
        line_ += static_cast<std::size_t>(std::ranges::count(comment, '\n'));
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  std::string_view limits_;
  std::size_t line_ = 1;
};

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// Of "@name(argument, ...) @name(...) whatever follows".
std::vector<IdlLimit> limits_of(std::string_view comment) {
  std::vector<IdlLimit> limits;
  while (comment.starts_with('@')) {
    const std::size_t open = comment.find('(');
    const std::size_t close = comment.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) break;
    IdlLimit& limit = limits.emplace_back();
    limit.name = comment.substr(1, open - 1);
    std::string_view rest = comment.substr(open + 1, close - open - 1);
    while (!without_blanks(rest).empty()) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      limit.arguments.emplace_back(without_blanks(rest.substr(0, comma)));
      rest.remove_prefix(std::min(comma + 1, rest.size()));
    }
    comment = without_blanks(comment.substr(close + 1));
  }
  return limits;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : lexer_(text) { advance(); }

  IdlTypes parse() {
    while (!token_.text.empty()) definition();
    return std::move(types_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw IdlError(token_.line, what); }

  [[nodiscard]] std::string quoted() const {
    return token_.text.empty() ? "the end" : "'" + std::string(token_.text.substr(0, 40)) + "'";
  }

  void advance() { token_ = lexer_.next(); }

  bool accept(std::string_view text) {
    if (token_.text != text) return false;
    advance();
    return true;
  }

  void expect(std::string_view text) {
    if (!accept(text)) fail("expected '" + std::string(text) + "', found " + quoted());
  }

  std::string name() {
    if (token_.text.empty() || !starts_name(token_.text[0])) {
      fail("expected a name, found " + quoted());
    }
    std::string result(token_.text);
    advance();
    return result;
  }

  std::size_t positive_number() {
    std::uint32_t value = 0;
    const char* end = token_.text.data() + token_.text.size();
    const auto [stop, error] = std::from_chars(token_.text.data(), end, value);
    if (error != std::errc() || stop != end || value == 0) {
      fail("expected a number from 1 to 4294967295, found " + quoted());
    }
    advance();
    return value;
  }

  void annotations() {
    while (accept("@")) {
      if (std::ranges::find(ignored_annotations, token_.text) == ignored_annotations.end()) {
        fail("unsupported annotation " + quoted());
      }
      advance();
      if (!accept("(")) continue;
      while (!accept(")")) {
        if (token_.text.empty()) fail("an annotation is not closed");
        advance();
      }
    }
  }

  void definition() {
    annotations();
    if (accept("module")) {
      module();
    } else if (accept("struct")) {
      structure();
    } else if (accept("enum")) {
      enumeration();
    } else {
      fail("unsupported " + quoted() + ": only module, struct and enum are known here");
    }
    expect(";");
  }

  void module() {
    if (modules_.size() >= deepest_declaration) fail("modules are nested too deeply");
    modules_.push_back(name());
    expect("{");
    while (!accept("}")) definition();
    modules_.pop_back();
  }

  /// The name inside the first `depth` of the modules that are open.
  [[nodiscard]] std::string full_name(std::string_view own, std::size_t depth) const {
    std::string result;
    for (std::size_t i = 0; i < depth; ++i) result += modules_[i] + "::";
    return result.append(own);
  }

  std::string new_name() {
    const std::size_t line = token_.line;
    std::string full = full_name(name(), modules_.size());
    if (types_.find(full) != nullptr) throw IdlError(line, full + " is declared twice");
    return full;
  }

  void structure() {
    IdlType type{IdlKind::structure, new_name()};
    if (token_.text == ":") fail("unsupported ':': structures with a base");
    expect("{");
    do {
      annotations();
      const std::size_t base = type_reference(0);
      do field(base, type.fields);
      while (accept(","));
      expect(";");
      type.fields.back().limits = limits_of(lexer_.limits());
    } while (!accept("}"));
    add(std::move(type));
  }

  void field(std::size_t type, std::vector<IdlField>& fields) {
    const std::size_t line = token_.line;
    IdlField result{name(), type};
    if (std::ranges::find(fields, result.name, &IdlField::name) != fields.end()) {
      throw IdlError(line, "field '" + result.name + "' is declared twice");
    }
    std::vector<std::size_t> bounds;
    while (accept("[")) {
      if (bounds.size() >= deepest_declaration) fail("an array has too many dimensions");
      bounds.push_back(positive_number());
      expect("]");
    }
    // The last bound is of the innermost array.
    while (!bounds.empty()) {
      result.type = add({IdlKind::array, {}, result.type, bounds.back()});
      bounds.pop_back();
    }
    fields.push_back(std::move(result));
  }

  void enumeration() {
    IdlType type{IdlKind::enumeration, new_name()};
    expect("{");
    do type.enumerators.push_back(name());
    while (accept(","));
    expect("}");
    add(std::move(type));
  }

  std::size_t add(IdlType type) {
    if (types_.types.size() >= most_types) fail("too many types");
    types_.types.push_back(std::move(type));
    return types_.types.size() - 1;
  }

  std::optional<IdlKind> integer() {
    const bool is_unsigned = accept("unsigned");
    if (accept("short")) return is_unsigned ? IdlKind::uint16 : IdlKind::int16;
    if (accept("long")) {
      if (accept("long")) return is_unsigned ? IdlKind::uint64 : IdlKind::int64;
      if (token_.text == "double") fail("unsupported 'long double'");
      return is_unsigned ? IdlKind::uint32 : IdlKind::int32;
    }
    if (is_unsigned) fail("expected 'short' or 'long', found " + quoted());
    return std::nullopt;
  }

  std::optional<IdlKind> primitive() {
    static constexpr std::pair<std::string_view, IdlKind> names[] = {
        {"boolean", IdlKind::boolean}, {"char", IdlKind::character}, {"octet", IdlKind::uint8},
        {"int8", IdlKind::int8},       {"uint8", IdlKind::uint8},    {"int16", IdlKind::int16},
        {"uint16", IdlKind::uint16},   {"int32", IdlKind::int32},    {"uint32", IdlKind::uint32},
        {"int64", IdlKind::int64},     {"uint64", IdlKind::uint64},  {"float", IdlKind::float32},
        {"double", IdlKind::float64}};
    for (const auto& [text, kind] : names) {
      if (accept(text)) return kind;
    }
    return integer();
  }

  std::size_t type_reference(std::size_t depth) {
    if (depth >= deepest_declaration) fail("sequences are nested too deeply");
    if (const auto kind = primitive()) return add({*kind});
    if (accept("string")) {
      IdlType type{IdlKind::string};
      if (accept("<")) {
        type.bound = positive_number();
        expect(">");
      }
      return add(std::move(type));
    }
    if (accept("sequence")) {
      expect("<");
      IdlType type{IdlKind::sequence};
      type.element = type_reference(depth + 1);
      if (accept(",")) type.bound = positive_number();
      expect(">");
      return add(std::move(type));
    }
    return named_type();
  }

  std::size_t named_type() {
    const std::size_t line = token_.line;
    const bool absolute = accept("::");
    std::string written = name();
    while (accept("::")) written += "::" + name();
    // Innermost module first.
    for (std::size_t depth = absolute ? 0 : modules_.size();; --depth) {
      if (const IdlType* type = types_.find(full_name(written, depth))) {
        return static_cast<std::size_t>(type - types_.types.data());
      }
      if (depth == 0) throw IdlError(line, "unknown type '" + written + "'");
    }
  }

  Lexer lexer_;
  Token token_;
  std::vector<std::string> modules_;
  IdlTypes types_;
};

}  // namespace

const IdlType* IdlTypes::find(std::string_view name) const {
  if (name.empty()) return nullptr;
  const auto found = std::ranges::find(types, name, &IdlType::name);
  return found == types.end() ? nullptr : &*found;
}

IdlTypes parse_idl(std::string_view text) { return Parser(text).parse(); }

}  // namespace quoin::topics
