// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>

#include "core/parameters/parameter.hpp"
#include "services/viewer/server.hpp"

namespace quoin::viewer {

struct ViewerParameters {
  std::string address = "127.0.0.1";
  std::int64_t port = 8765;
  std::string token;
  std::string hosts;
  std::string origins;
  std::string certificate;
  std::string key;
  std::int64_t clients = 16;
  double buffer = 10.0;  ///< [MB]

  static constexpr auto fields() {
    using P = ViewerParameters;
    return std::make_tuple(
        field(&P::address, "address",
              "IP address to listen at; any but 127.0.0.1 needs a token, 0.0.0.0 is all of them"),
        field(&P::port, "port", "", 0.0, 65535.0, "TCP port of the page; 0 is any that is free"),
        field(
            &P::token, "token",
            "what clients have to know, at least 16 characters (such as ${QUOIN_TOKEN}); when the "
            "address needs one and none is given, one is made and logged"),
        field(&P::hosts, "hosts",
              "names by which browsers may call this host besides its addresses, with commas"),
        field(&P::origins, "origins",
              "pages of others that may connect, with commas, such as https://app.foxglove.dev"),
        field(&P::certificate, "certificate",
              "PEM file (relative to the deployment file); with 'key' the page is served by TLS"),
        field(&P::key, "key", "PEM file of the private key of the certificate"),
        field(&P::clients, "clients", "", 1.0, 1000.0, "connected at a time, at most"),
        field(&P::buffer, "buffer", "", 0.1, 1000.0,
              "megabytes that wait for a slow client; what is more is dropped, the oldest first"));
  }
};

/// Paths count from `base`. Makes a token where one is needed and none is given. Throws
/// ParameterError.
[[nodiscard]] ServerSettings server_settings(const ViewerParameters& parameters,
                                             const std::filesystem::path& base);

[[nodiscard]] ClientLimits client_limits(const ViewerParameters& parameters);

}  // namespace quoin::viewer
