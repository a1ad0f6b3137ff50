// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include "services/deployment/deployment.hpp"
#include "services/viewer/protocol.hpp"

namespace quoin::viewer {

/// Answers why a service made no line somewhere, of the scans that came last.
class Explainer {
 public:
  explicit Explainer(Deployment deployment) : deployment_(std::move(deployment)) {}

  /// A scan that came by that topic, with its stamp [ns].
  void add(const std::string& topic, std::int64_t stamp, const Payload& scan);

  /// `request`: JSON with service, x and y [m, in the sensor's frame], and the stamp of the scan;
  /// without one it is the newest. Throws std::exception for what cannot be answered.
  [[nodiscard]] std::string answer(const std::string& request) const;

 private:
  struct Kept {
    std::string topic;
    std::int64_t stamp;
    Payload scan;
  };

  const Deployment deployment_;
  mutable std::mutex mutex_;
  std::deque<Kept> scans_;
  std::size_t bytes_ = 0;
};

}  // namespace quoin::viewer
