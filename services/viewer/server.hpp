// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "services/viewer/access.hpp"
#include "services/viewer/hub.hpp"

namespace quoin::viewer {

struct ServerSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8765;  ///< 0: any that is free
  AccessRules access = {};
  std::filesystem::path certificate = {};  ///< PEM; with a key the server speaks TLS
  std::filesystem::path key = {};
};

/// Serves the page and the WebSocket of a hub on one port, in a thread of its own. The page comes
/// out of the program; no file is read for anybody.
class Server {
 public:
  /// What operators should know: who was refused, and why.
  using Log = std::function<void(const std::string&)>;

  /// Throws std::runtime_error when the address, the port or the certificate cannot be used.
  Server(const ServerSettings& settings, Hub& hub, Log log);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// What a browser on this host opens, with the token where there is one.
  [[nodiscard]] std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace quoin::viewer
