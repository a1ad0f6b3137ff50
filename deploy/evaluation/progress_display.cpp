// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "deploy/evaluation/progress_display.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "deploy/observation/table.hpp"

namespace quoin::deploy {

namespace {

constexpr std::size_t bar_width = 24;

}  // namespace

std::string progress_bar(const EvaluationProgress& progress, double elapsed, std::size_t width) {
  const double share = progress.total == 0 ? 1.0
                                           : static_cast<double>(progress.done) /
                                                 static_cast<double>(progress.total);
  const auto full = static_cast<std::size_t>(share * static_cast<double>(bar_width));
  std::string line = "[" + std::string(full, '#') + std::string(bar_width - full, '.') + "] " +
                     fixed(100.0 * share, 0) + " %";
  // Early guesses are worse than none.
  if (share > 0.05 && elapsed > 1.0) {
    line += ", " + fixed(std::ceil(elapsed * (1.0 - share) / share), 0) + " s left";
  }
  line += "  " + progress.section + ": " + progress.job;
  return line.substr(0, width);
}

ProgressDisplay::ProgressDisplay(std::ostream& out, bool terminal, std::size_t width)
    : out_(out), terminal_(terminal), width_(width) {}

ProgressDisplay::~ProgressDisplay() {
  if (terminal_) out_ << "\r\033[K" << std::flush;
}

void ProgressDisplay::show(const EvaluationProgress& progress) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (terminal_) {
    // One column less: a full line would wrap on some terminals.
    out_ << '\r' << progress_bar(progress, elapsed, width_ - std::min<std::size_t>(1, width_))
         << "\033[K" << std::flush;
    return;
  }
  for (; told_ < progress.finished.size(); ++told_) {
    out_ << progress.finished[told_] << ": done after " << fixed(elapsed, 1) << " s" << std::endl;
  }
}

}  // namespace quoin::deploy
