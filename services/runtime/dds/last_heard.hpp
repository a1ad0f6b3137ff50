// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "services/runtime/dds/fast_dds.hpp"

#ifndef QUOIN_FAST_DDS_2

namespace quoin::runtime {

/// When other participants were heard last, which Fast DDS 2 tells and 3 keeps to itself.
class LastHeard {
 public:
  using Prefix = std::array<std::uint8_t, 12>;  // of the participant
  using Time = std::chrono::steady_clock::time_point;

  /// From now on a transport tells whom it hears. Without one nothing is kept.
  void begin();
  /// Only of participants that are watched anything is kept. One that is watched anew counts as
  /// heard now.
  void watch(const Prefix& participant);
  void forget(const Prefix& participant);
  void heard(const Prefix& participant);
  [[nodiscard]] std::optional<Time> of(const Prefix& participant) const;

 private:
  mutable std::mutex mutex_;
  bool begun_ = false;
  std::map<Prefix, Time> times_;
};

/// A transport that receives and sends what `below` does, and tells `last_heard` of whom.
[[nodiscard]] std::shared_ptr<fast_dds::rtps::TransportDescriptorInterface> listened_to(
    std::shared_ptr<fast_dds::rtps::TransportDescriptorInterface> below,
    std::shared_ptr<LastHeard> last_heard);

}  // namespace quoin::runtime

#endif
