// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sensor_bridge/transport/file_descriptor.hpp"

namespace quoin::tests {

class LossyWire;

/// Hosts in network namespaces of their own, on one switch: host number i (from 0) has the address
/// 10.77.0.(i + 1) on eth0 and 10.78.0.(i + 1) on aux0, which has a switch of its own. Nothing of
/// it is outside this process, so nothing of it outlives it.
///
/// The thread that makes it stands on the last host from then on.
class Hosts {
 public:
  /// Why this machine does not let us make such hosts, or links that lose; nothing when it does.
  [[nodiscard]] static std::optional<std::string> refusal(bool lossy = false);

  /// The link of `lossy`, if that is not "", can be impaired.
  explicit Hosts(std::vector<std::string> names, const std::string& lossy = "");
  ~Hosts();
  Hosts(const Hosts&) = delete;
  Hosts& operator=(const Hosts&) = delete;

  /// Calls `function` while this thread stands on `host`; processes that it starts run there.
  template <class Function>
  auto on(const std::string& host, Function function) const {
    const Visit visit(*this, host);
    return function();
  }

  /// Takes the link of `host` down at the switch, so that the host sees no carrier, or up again.
  void cut(const std::string& host) const;
  void mend(const std::string& host) const;
  /// Frames that `interface` of `host` has sent and received.
  [[nodiscard]] std::uint64_t frames(const std::string& host, const std::string& interface) const;
  /// IP packets that `host` has sent and that were parts of larger ones.
  [[nodiscard]] std::uint64_t fragments(const std::string& host) const;
  /// From now on, of what passes the lossy link (both ways) each frame is lost with this
  /// probability, the others are late.
  void impair(double loss, std::chrono::milliseconds delay) const;

 private:
  class Visit {
   public:
    Visit(const Hosts& hosts, const std::string& host);
    ~Visit();
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

   private:
    const Hosts& hosts_;
  };

  void connect(const std::string& host, std::size_t number);

  sensor_bridge::FileDescriptor outside_;
  sensor_bridge::FileDescriptor switch_;
  std::map<std::string, sensor_bridge::FileDescriptor> hosts_;
  std::string home_;  ///< the host on which the thread stands
  std::string lossy_;
  std::unique_ptr<LossyWire> wire_;  ///< null: the kernel impairs links itself
};

}  // namespace quoin::tests
