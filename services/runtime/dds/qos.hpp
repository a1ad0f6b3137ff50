// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "services/deployment/deployment.hpp"

namespace quoin::runtime {

/// Named sets of QoS policies; writer and reader of a topic use the same.
enum class QosPreset {
  sensor,    ///< reliable, volatile, keep last 5: the newest scans matter
  feature,   ///< reliable, volatile, keep last 32
  state,     ///< reliable, transient-local, keep last 1 per instance: late joiners get the latest
  control,   ///< reliable, volatile, keep last 256: requests and replies
  observer,  ///< of readers: reliable, volatile, keep last 4096: bursts arrive, no writer waits
  lossless,  ///< reliable, keep all: a slow reader slows the writer down (replay, evaluation)
  best_effort,  ///< volatile, keep last 32, nothing is sent again: what external services write
};

/// Throws std::invalid_argument for an unknown name.
[[nodiscard]] QosPreset qos_preset(std::string_view name);

/// What writer and readers of one topic agree on.
struct TopicQos {
  QosPreset preset = QosPreset::feature;
  /// Set where several writers stand in for each other (exclusive ownership): readers hear the
  /// strongest that lives. What a reader has here only needs to be set.
  std::optional<int> strength;
  /// A writer that neither wrote nor asserted its liveliness for this long is taken for dead; the
  /// same for all writers and readers of a topic.
  std::chrono::milliseconds lease{100};
  /// Messages that the history holds in place of as many as the preset says.
  std::optional<int> depth = std::nullopt;
  /// What the endpoint announces beside it, for those who know of it.
  std::string user_data = {};
  /// Label of the service that it belongs to, where others are to learn that
  /// (Participant::watch_endpoints).
  std::string owner = {};

  TopicQos(QosPreset preset_of_topic) : preset(preset_of_topic) {}
};

/// How many messages a reader of that preset may be behind.
[[nodiscard]] int history_depth(QosPreset preset);
/// Messages that a reader in the same process may be behind: as many as DDS would keep for it.
[[nodiscard]] std::size_t queue_depth(QosPreset preset);

/// Of an output of `service`, for its writer and for its readers.
[[nodiscard]] TopicQos output_qos(const ServiceConfig& service, const OutputConfig& output);

/// Of a reader of that output that only looks, and must not slow the writer down as a lossless one
/// would.
[[nodiscard]] TopicQos observer_qos(const ServiceConfig& service, const OutputConfig& output);

}  // namespace quoin::runtime
