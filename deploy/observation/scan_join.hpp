// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <idl/Circles.h>
#include <idl/Corners.h>
#include <idl/Lines.h>
#include <idl/Segments.h>
#include <map>
#include <optional>
#include <string>

#include "deploy/evaluation/drawing/drawing.hpp"
#include "services/deployment/deployment.hpp"
#include "services/runtime/dds/endpoints.hpp"
#include "services/runtime/dds/participant.hpp"

namespace quoin::deploy {

/// The services that a corner service gets its corners from.
struct CornerChain {
  const ServiceConfig* source;
  const ServiceConfig* segmentation;
  const ServiceConfig* line_fitting;
  const ServiceConfig* corners;
  const ServiceConfig* circles;  ///< the first of the same segments; null when there is none

  /// Whether the picture needs what this service gives.
  [[nodiscard]] bool shows(const ServiceConfig& service) const {
    return &service == segmentation || &service == line_fitting || &service == corners ||
           &service == circles;
  }
};

/// Throws std::out_of_range when `name` is no corner service of the deployment.
[[nodiscard]] CornerChain corner_chain(const Deployment& deployment, const std::string& name);

/// Brings the segments, lines, corners and circles of one scan together again.
class ScanJoin {
 public:
  /// `scan`: the wanted sequence number; nothing: the first that is complete.
  ScanJoin(const Deployment& deployment, const CornerChain& chain,
           std::optional<std::uint64_t> scan);

  /// Waits up to `timeout` for messages; the drawing once all parts of a scan are there.
  [[nodiscard]] std::optional<Drawing> poll(std::chrono::milliseconds timeout);
  /// Newest scan seen; nothing before the first.
  [[nodiscard]] std::optional<std::uint64_t> newest() const { return newest_; }

 private:
  struct Parts {
    std::optional<msg::Segments> segments;
    std::optional<msg::Lines> lines;
    std::optional<msg::Corners> corners;
    std::optional<msg::Circles> circles;
  };
  template <class T>
  void take(runtime::Reader<T>& reader, std::optional<T> Parts::*part);
  [[nodiscard]] Drawing draw(const Parts& parts) const;

  const CornerChain chain_;
  std::optional<std::uint64_t> scan_;
  std::optional<std::uint64_t> newest_;
  runtime::Participant participant_;
  runtime::Reader<msg::Segments> segments_;
  runtime::Reader<msg::Lines> lines_;
  runtime::Reader<msg::Corners> corners_;
  std::optional<runtime::Reader<msg::Circles>> circles_;
  runtime::WaitSet wait_set_;
  std::map<std::uint64_t, Parts> parts_;
};

}  // namespace quoin::deploy
