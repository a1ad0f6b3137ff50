// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/mapping/landmark_graph.hpp"

namespace quoin {

inline constexpr double loop_gate = 30.0;  ///< chi square of 3 of what closes a loop

/// A trial of a loop on a copy of the graph, one Gauss-Newton step at a time: first the graph as it
/// is, then with the loop however far it bends the map, then with the loop weighted like the rest.
/// Each of these ends early when nothing moves any more.
class LoopTrial {
 public:
  enum class Verdict { open, holds, refuted };

  LoopTrial() = default;
  /// `edge` closes the loop; `agreeing` are edges of other keyframes that say the same.
  LoopTrial(const LandmarkGraph& graph, std::span<const LandmarkGraph::Edge> agreeing,
            const LandmarkGraph::Edge& edge);

  /// Takes one step; not to be called when the verdict is not open.
  Verdict step();
  /// The graph with the loop; of a trial that holds.
  [[nodiscard]] const LandmarkGraph& graph() const { return graph_; }
  /// What closes the loop, the last of them the edge that was tried.
  [[nodiscard]] std::span<const LandmarkGraph::Edge> loop() const { return loop_; }

  template <class Archive, class Self>
  static void transfer(Archive& archive, Self& self) {
    archive(self.graph_, self.loop_, self.first_loop_, self.phase_, self.steps_, self.cost_before_,
            self.cost_after_);
  }

 private:
  enum class Phase { without, trusted, weighted };

  void end_phase();
  [[nodiscard]] Verdict judge() const;

  LandmarkGraph graph_;
  std::vector<LandmarkGraph::Edge> loop_;
  std::size_t first_loop_ = 0;  // edge of graph_
  Phase phase_ = Phase::without;
  int steps_ = 0;  // of this phase
  double cost_before_ = 0.0;
  double cost_after_ = 0.0;
};

}  // namespace quoin
