// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <poll.h>
#include <span>
#include <string>
#include <vector>

#include "sensor_bridge/rplidar/emulator/emulator_settings.hpp"

namespace quoin::sensor_bridge::rplidar {

/// Where clients find an emulated device. No call waits: what a client does not take at once is
/// lost, as on a serial line.
class Link {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  /// Called when a client connects or disconnects.
  using Report = std::function<void(const std::string&)>;

  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;
  virtual ~Link() = default;

  /// Makes the endpoint. Throws std::system_error or std::runtime_error when it cannot be had.
  virtual void plug_in() = 0;
  /// Takes the endpoint away; clients notice.
  virtual void unplug() = 0;
  [[nodiscard]] virtual bool plugged_in() const = 0;

  /// "/dev/pts/4" or its symbolic link, "tcp://127.0.0.1:20108", "udp://127.0.0.1:8089"; the last
  /// one while unplugged.
  [[nodiscard]] virtual std::string endpoint() const = 0;

  /// Appends what is to be polled for input.
  virtual void watch(std::vector<pollfd>& descriptors) const = 0;
  /// Appends what clients have sent.
  virtual void read(std::vector<std::uint8_t>& bytes) = 0;
  virtual void write(std::span<const std::uint8_t> bytes, TimePoint now) = 0;
  /// When `write` wants to be called again, if only with nothing.
  [[nodiscard]] virtual std::optional<TimePoint> next_write() const { return std::nullopt; }
  /// [bit/s] that the client has set; nothing where there is no such setting.
  [[nodiscard]] virtual std::optional<unsigned> baud_rate() const { return std::nullopt; }

  [[nodiscard]] std::uint64_t sent_bytes() const { return sent_bytes_; }
  [[nodiscard]] std::uint64_t lost_bytes() const { return lost_bytes_; }

 protected:
  /// Counts what was handed to write and what of it was taken.
  void count(std::size_t offered, std::size_t taken) {
    sent_bytes_ += taken;
    lost_bytes_ += offered - taken;
  }

 private:
  std::uint64_t sent_bytes_ = 0;
  std::uint64_t lost_bytes_ = 0;
};

/// The link that the settings ask for, not plugged in yet. Throws std::invalid_argument.
[[nodiscard]] std::unique_ptr<Link> make_link(const EmulatorSettings& settings,
                                              Link::Report report);

}  // namespace quoin::sensor_bridge::rplidar
