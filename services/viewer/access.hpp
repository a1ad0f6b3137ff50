// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace quoin::viewer {

/// Who may connect.
struct AccessRules {
  std::vector<std::string> hosts = {};    ///< names that this host is called, besides its addresses
  std::vector<std::string> origins = {};  ///< of pages of others that may connect
  std::string token = {};                 ///< "" when none is needed
};

/// What a request says of itself.
struct Caller {
  std::string_view host;                   ///< the header Host
  std::optional<std::string_view> origin;  ///< of a browser: where the page is from
  std::string_view target;                 ///< of the request, with its query
  std::string_view authorization;          ///< "Bearer ..." or ""
};

enum class Refusal { none, host, origin, token };

/// Whether a page may be fetched. A name that an attacker's DNS resolves to this host stands in
/// Host, so that only addresses, localhost and the names of the rules are good.
[[nodiscard]] Refusal may_fetch(const AccessRules& rules, const Caller& caller);

/// Whether a WebSocket may be opened. Browsers let any page do that, and say of which origin it is:
/// it has to be our own page or one that is listed. What is no browser says nothing.
[[nodiscard]] Refusal may_connect(const AccessRules& rules, const Caller& caller);

/// Whether an address is reachable from this host alone: 127.x.x.x, ::1 or localhost.
[[nodiscard]] bool is_loopback(std::string_view address);

/// 32 hexadecimal digits that nobody can guess. Throws std::runtime_error.
[[nodiscard]] std::string random_token();

}  // namespace quoin::viewer
