// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "deploy/quoin/lidar_report.hpp"

namespace quoin::deploy {

enum class Verdict { good, doubtful, bad };

/// "ok", "doubtful", "bad".
[[nodiscard]] std::string verdict_name(Verdict verdict);

/// One thing that was looked at.
struct LidarCheck {
  std::string name;
  Verdict verdict = Verdict::good;
  std::string text;
  std::string advice;  ///< what to do; empty when it is good
};

/// What the report says, thing by thing, until one makes the others pointless.
[[nodiscard]] std::vector<LidarCheck> lidar_checks(const LidarReport& report);

}  // namespace quoin::deploy
