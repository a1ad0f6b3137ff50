// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/bundle/redaction.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace quoin::deploy {

namespace {

constexpr const char* hidden = "(hidden)";
constexpr std::array<std::string_view, 9> secret_words{"token",      "password", "passwd",
                                                       "passphrase", "secret",   "credential",
                                                       "apikey",     "api_key",  "authorization"};
// A shorter value would hide parts of other words.
constexpr std::size_t shortest_value = 4;

bool of_name(char character) {
  return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_' ||
         character == '-' || character == '.';
}

void replace_all(const std::string& what, std::string& text) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), hidden);
    at += std::string_view(hidden).size();
  }
}

/// Where the value that begins at `at` ends: at its closing quote, or before what ends a value in
/// YAML, JSON or a list of settings.
std::size_t end_of_value(const std::string& text, std::size_t at) {
  const char quote = text[at];
  if (quote == '"' || quote == '\'') {
    const std::size_t end = text.find(quote, at + 1);
    return end == std::string::npos ? text.size() : end + 1;
  }
  const std::size_t end = text.find_first_of(",}\n", at);
  return end == std::string::npos ? text.size() : end;
}

void hide_named_values(std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    if (!of_name(text[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < text.size() && of_name(text[end])) ++end;
    const std::string_view name(text.data() + at, end - at);
    at = end;
    if (!is_secret_name(name)) continue;
    std::size_t value = end;
    if (value < text.size() && (text[value] == '"' || text[value] == '\'')) ++value;
    while (value < text.size() && text[value] == ' ') ++value;
    if (value >= text.size() || (text[value] != ':' && text[value] != '=')) continue;
    ++value;
    while (value < text.size() && text[value] == ' ') ++value;
    if (value >= text.size() || text[value] == '\n') continue;
    text.replace(value, end_of_value(text, value) - value, hidden);
    at = value + std::string_view(hidden).size();
  }
}

/// "://user:password@" keeps the user.
void hide_passwords_of_urls(std::string& text) {
  for (std::size_t at = text.find("://"); at != std::string::npos; at = text.find("://", at + 3)) {
    const std::size_t end = std::min(text.find_first_of("/ \n\"'", at + 3), text.size());
    const std::size_t host = text.rfind('@', end);
    const std::size_t colon = text.find(':', at + 3);
    if (host == std::string::npos || colon >= host || host < at) continue;
    text.replace(colon + 1, host - colon - 1, hidden);
  }
}

void hide_private_keys(std::string& text) {
  const std::string_view mark = "PRIVATE KEY-----";
  for (std::size_t begin = text.find("-----BEGIN "); begin != std::string::npos;
       begin = text.find("-----BEGIN ", begin + 1)) {
    const std::size_t body = text.find(mark, begin);
    if (body == std::string::npos || body > text.find('\n', begin)) continue;
    const std::size_t last = text.find(mark, body + mark.size());
    const std::size_t end = last == std::string::npos ? text.size() : last + mark.size();
    text.replace(begin, end - begin, hidden);
  }
}

}  // namespace

bool is_secret_name(std::string_view name) {
  std::string lower;
  for (const char character : name) {
    lower += static_cast<char>(std::tolower(static_cast<unsigned char>(character)));
  }
  return std::ranges::any_of(
             secret_words, [&](std::string_view word) { return lower.find(word) != lower.npos; }) ||
         lower == "key" || lower.ends_with("_key") || lower.ends_with("_pin");
}

Redaction::Redaction(const std::vector<std::string>& environment) {
  for (const std::string& variable : environment) {
    const std::size_t equals = variable.find('=');
    if (equals == std::string::npos || !is_secret_name(variable.substr(0, equals))) continue;
    std::string value = variable.substr(equals + 1);
    if (value.size() >= shortest_value) values_.push_back(std::move(value));
  }
  // What holds another one goes first.
  std::ranges::sort(values_, std::ranges::greater(), &std::string::size);
}

std::string Redaction::operator()(std::string text) const {
  for (const std::string& value : values_) replace_all(value, text);
  hide_private_keys(text);
  hide_passwords_of_urls(text);
  hide_named_values(text);
  return text;
}

}  // namespace quoin::deploy
