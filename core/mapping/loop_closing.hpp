// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/mapping/loop_search.hpp"

namespace quoin {

/// Closes loops of a graph whose keyframes come one after the other, and takes out those that prove
/// wrong later. A loop is closed when two pairs of keyframes say the same, and the graph can
/// explain it.
class LoopClosing {
 public:
  /// After a keyframe was added. True when that has closed a loop.
  bool close(LandmarkGraph& graph, const KeyframePoints& clouds);
  /// Takes loops out that what came after them refutes.
  void check(LandmarkGraph& graph);
  [[nodiscard]] std::size_t closed() const { return closed_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.last_keyframe_, self.closed_, self.found_);
  }

 private:
  std::size_t last_keyframe_ = 0;           // from which a loop was looked for
  std::vector<LandmarkGraph::Edge> found_;  // that no other one agrees with yet
  std::size_t closed_ = 0;
};

}  // namespace quoin
