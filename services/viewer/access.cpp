// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/access.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <sys/random.h>

namespace quoin::viewer {

namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// Without the port.
std::string name_of(std::string_view host) {
  if (host.starts_with('[')) return lower(host.substr(0, host.find(']') + 1));
  return lower(host.substr(0, host.find(':')));
}

bool is_address(std::string_view name) {
  if (name.starts_with('[')) return name.ends_with(']');
  return !name.empty() && name.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool good_host(const AccessRules& rules, std::string_view host) {
  const std::string name = name_of(host);
  if (name == "localhost" || is_address(name)) return true;
  return std::ranges::any_of(rules.hosts, [&](const auto& each) { return lower(each) == name; });
}

bool good_origin(const AccessRules& rules, const Caller& caller) {
  if (!caller.origin) return true;
  const std::string origin = lower(*caller.origin);
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && origin.substr(scheme.size()) == lower(caller.host))
      return true;
  }
  return std::ranges::any_of(rules.origins,
                             [&](const auto& each) { return lower(each) == origin; });
}

/// Takes as long for any text of that length.
bool same(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference |=
        static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]));
  }
  return difference == 0;
}

std::string_view token_of(const Caller& caller) {
  constexpr std::string_view bearer = "Bearer ";
  if (caller.authorization.starts_with(bearer)) return caller.authorization.substr(bearer.size());
  constexpr std::string_view key = "token=";
  std::string_view query =
      caller.target.substr(std::min(caller.target.find('?'), caller.target.size()));
  while (!query.empty()) {
    query.remove_prefix(1);  // ? or &
    const std::string_view entry = query.substr(0, query.find('&'));
    if (entry.starts_with(key)) return entry.substr(key.size());
    query.remove_prefix(entry.size());
  }
  return {};
}

}  // namespace

Refusal may_fetch(const AccessRules& rules, const Caller& caller) {
  return good_host(rules, caller.host) ? Refusal::none : Refusal::host;
}

Refusal may_connect(const AccessRules& rules, const Caller& caller) {
  if (!good_host(rules, caller.host)) return Refusal::host;
  if (!good_origin(rules, caller)) return Refusal::origin;
  if (!rules.token.empty() && !same(token_of(caller), rules.token)) return Refusal::token;
  return Refusal::none;
}

bool is_loopback(std::string_view address) {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

std::string random_token() {
  unsigned char bytes[16];
  if (::getrandom(bytes, sizeof bytes, 0) != static_cast<ssize_t>(sizeof bytes)) {
    throw std::runtime_error("no random numbers for a token");
  }
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace quoin::viewer
