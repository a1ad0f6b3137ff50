// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/mapping/loop_search.hpp"
#include "core/mapping/loop_trial.hpp"

namespace quoin {

/// Closes loops of a graph whose keyframes come one after the other, and takes out those that prove
/// wrong later. A loop is closed when two pairs of keyframes say the same, and the graph can
/// explain it. Looking for one and trying it is work that is spread over scans, in units of
/// Gauss-Newton steps, so that the same scans give the same map on any machine.
class LoopClosing {
 public:
  /// The work of one scan: looks for a loop from the last keyframe, or tries the one that was
  /// found.
  void work(const LandmarkGraph& graph, const KeyframePoints& clouds);
  /// Closes the loop that work has shown to hold. False when there is none.
  bool close(LandmarkGraph& graph);
  /// Takes loops out that what came after them refutes.
  void check(LandmarkGraph& graph);
  [[nodiscard]] std::size_t closed() const { return closed_; }
  /// Whether a loop is tried at present.
  [[nodiscard]] bool is_trying() const { return trial_.has_value() && !holds_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.last_keyframe_, self.closed_, self.found_, self.trial_, self.holds_);
  }

 private:
  void search(const LandmarkGraph& graph, const KeyframePoints& clouds);
  void go_on_trying();

  std::size_t last_keyframe_ = 0;           // from which a loop was looked for
  std::vector<LandmarkGraph::Edge> found_;  // that no other one agrees with yet
  std::size_t closed_ = 0;
  std::optional<LoopTrial> trial_;
  bool holds_ = false;  // the trial, and waits to be closed
};

}  // namespace quoin
