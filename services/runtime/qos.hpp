// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace quoin::runtime {

/// Named sets of QoS policies; writer and reader of a topic use the same.
enum class QosPreset {
  sensor,    ///< reliable, volatile, keep last 5: the newest scans matter
  feature,   ///< reliable, volatile, keep last 32
  state,     ///< reliable, transient-local, keep last 1 per instance: late joiners get the latest
  control,   ///< reliable, volatile, keep last 256: requests and replies
  lossless,  ///< reliable, keep all: a slow reader slows the writer down (replay, evaluation)
};

/// Throws std::invalid_argument for an unknown name.
[[nodiscard]] QosPreset qos_preset(std::string_view name);

}  // namespace quoin::runtime
