// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <string>

#include "deploy/evaluation/evaluation.hpp"

namespace quoin::deploy {

/// Shows how far an evaluation is: a bar that is redrawn in place on a terminal, elsewhere a line
/// for each section that is complete.
class ProgressDisplay {
 public:
  ProgressDisplay(std::ostream& out, bool terminal, std::size_t width);
  /// Takes the bar away.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  void show(const EvaluationProgress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  bool terminal_;
  std::size_t width_;
  Clock::time_point start_ = Clock::now();
  std::size_t told_ = 0;  // sections
};

/// The bar of `width` characters: share of the jobs, time left and what is being computed.
[[nodiscard]] std::string progress_bar(const EvaluationProgress& progress, double elapsed,
                                       std::size_t width);

}  // namespace quoin::deploy
