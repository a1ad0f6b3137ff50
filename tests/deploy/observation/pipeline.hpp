// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <idl/Common.h>
#include <idl/Status.h>
#include <string>
#include <vector>

#include "services/topics/header.hpp"

namespace quoin::deploy {

/// Services one behind the other, the source first, which can be told to lose scans or to restart;
/// makes the headers that leave the last one.
class Pipeline {
 public:
  static constexpr std::size_t all = 1000;
  static constexpr std::int64_t delay = 2'000'000;  ///< [ns] of each stage

  /// The process of the first stage starts at 11, that of the second at 12, and so on.
  explicit Pipeline(const std::vector<std::string>& services) {
    for (const std::string& service : services) {
      stages_.push_back({service, 11 + stages_.size(), 0});
    }
  }

  /// The next scan; the stages from `passed` on have not got it.
  msg::Header scan(std::size_t passed = all) {
    msg::Header header;
    topics::set_origin(header, stages_[0].service, stages_[0].incarnation, next_);
    ++next_;
    std::int64_t published = time_ += 100'000'000;
    for (std::size_t i = 0; i < std::min(passed, stages_.size()); ++i, published += delay) {
      msg::StageTrace& trace = header.trace().emplace_back();
      trace.service(stages_[i].service);
      trace.incarnation(stages_[i].incarnation);
      trace.index(stages_[i].published++);
      trace.published(published);
    }
    return header;
  }

  /// Another process does the work of that stage from the next scan on; a source counts from 0.
  void restart(std::size_t stage, std::uint64_t incarnation) {
    stages_[stage].incarnation = incarnation;
    stages_[stage].published = 0;
    if (stage == 0) next_ = 0;
  }

 private:
  struct Stage {
    std::string service;
    std::uint64_t incarnation;
    std::uint64_t published;
  };
  std::vector<Stage> stages_;
  std::uint64_t next_ = 0;
  std::int64_t time_ = 0;  // [ns]
};

/// A heartbeat of the process that started at `incarnation`, whose id is that and 100.
[[nodiscard]] inline msg::ServiceStatus heartbeat(
    const std::string& service, std::uint64_t incarnation, std::uint64_t published = 0,
    msg::ServiceState state = msg::ServiceState::STATE_ACTIVE) {
  msg::ServiceStatus status;
  status.service(service);
  status.incarnation(incarnation);
  status.pid(static_cast<std::uint32_t>(100 + incarnation));
  status.state(state);
  status.received(published);
  status.published(published);
  return status;
}

}  // namespace quoin::deploy
