// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quoin::runtime {

/// What the writer of a service announces beside its endpoint; `incarnation` of its process.
[[nodiscard]] std::string writer_announcement(std::uint64_t incarnation);
/// The incarnation that a writer announces; 0 for one that is not of a service.
[[nodiscard]] std::uint64_t announced_incarnation(std::string_view user_data);

/// Who is heard on a topic. While a writer that announces itself as that of a service is alive,
/// nobody is who does not; it speaks for its own process alone. Among others, as tests and services
/// of strangers are, the first that is heard has the name of a process, until it has been silent
/// while another one claims it.
class ProcessWriters {
 public:
  using Clock = std::chrono::steady_clock;

  explicit ProcessWriters(std::function<Clock::time_point()> now = Clock::now)
      : now_(std::move(now)) {}

  /// Whether a message of that process of `service` may come from `writer`, which announces the
  /// incarnation `announced`.
  [[nodiscard]] bool admit(const std::string& service, std::uint64_t incarnation,
                           std::uint64_t writer, std::uint64_t announced = 0);

  /// Whether messages of writers that announce nothing are heard at all.
  [[nodiscard]] bool hears_strangers() const;

 private:
  struct Entry {
    std::string service;
    std::uint64_t incarnation = 0;
    std::uint64_t writer = 0;
    std::optional<Clock::time_point> contested = {};  // since then by another, and not heard
  };
  void remember(const std::string& service, std::uint64_t incarnation, std::uint64_t writer);

  std::function<Clock::time_point()> now_;
  std::vector<Entry> entries_;  // in the order in which they were first heard
  std::optional<Clock::time_point>
      announced_heard_;  // the last message of one that announces itself
};

}  // namespace quoin::runtime
