// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "services/viewer/settings.hpp"

#include "core/parameters/parameter.hpp"

namespace quoin::viewer {

namespace {

constexpr std::size_t shortest_token = 16;

/// Tokens stand in addresses.
bool fits_address(const std::string& token) {
  return token.find_first_not_of(
             "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~") ==
         std::string::npos;
}

}  // namespace

ServerSettings server_settings(const ViewerParameters& parameters,
                               const std::filesystem::path& base) {
  ServerSettings settings{.address = parameters.address,
                          .port = static_cast<std::uint16_t>(parameters.port),
                          .access = {list_entries(parameters.hosts),
                                     list_entries(parameters.origins), parameters.token}};
  const std::string& token = parameters.token;
  if (!token.empty() && (token.size() < shortest_token || !fits_address(token))) {
    throw ParameterError(
        "token", "token has fewer than 16 characters, or others than letters, digits and -._~");
  }
  if (token.empty() && !is_loopback(parameters.address)) settings.access.token = random_token();
  if (parameters.certificate.empty() != parameters.key.empty()) {
    throw ParameterError("certificate", "certificate and key come together");
  }
  if (!parameters.key.empty()) {
    settings.certificate = base / parameters.certificate;
    settings.key = base / parameters.key;
  }
  return settings;
}

ClientLimits client_limits(const ViewerParameters& parameters) {
  return {.queued_bytes = static_cast<std::size_t>(parameters.buffer * 1e6)};
}

}  // namespace quoin::viewer
