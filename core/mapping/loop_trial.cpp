// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_trial.hpp"

#include <algorithm>

namespace quoin {
namespace {

constexpr double loop_cost = 100.0;  // of what closes a loop, for each pair of keyframes
constexpr int steps_without = 3;
constexpr int steps_trusted = 6;
constexpr int steps_weighted = 3;

}  // namespace

LoopTrial::LoopTrial(const LandmarkGraph& graph, std::span<const LandmarkGraph::Edge> agreeing,
                     const LandmarkGraph::Edge& edge)
    : graph_(graph), loop_(agreeing.begin(), agreeing.end()) {
  loop_.push_back(edge);
}

LoopTrial::Verdict LoopTrial::step() {
  const int step = steps_++;
  if (step < steps_without) {
    cost_before_ = graph_.optimize(1);
    return Verdict::open;
  }
  if (step == steps_without) {
    first_loop_ = graph_.edges().size();
    for (const LandmarkGraph::Edge& edge : loop_) {
      graph_.close_loop(edge.from, edge.to, edge.motion);
    }
  }
  if (step < steps_without + steps_trusted) {
    cost_after_ = graph_.optimize(1, true);
    return Verdict::open;
  }
  graph_.optimize(1);
  return step + 1 < steps_without + steps_trusted + steps_weighted ? Verdict::open : judge();
}

LoopTrial::Verdict LoopTrial::judge() const {
  double chi = 0.0;
  for (std::size_t i = first_loop_; i < graph_.edges().size(); ++i) {
    chi = std::max(chi, graph_.chi_square(graph_.edges()[i]));
  }
  // A map is more certain of itself than it should be, by errors that scans have in common. What
  // bends it far needs more pairs.
  const double allowed = loop_cost * static_cast<double>(loop_.size() - 1);
  return chi > loop_gate || cost_after_ - cost_before_ > allowed ? Verdict::refuted
                                                                 : Verdict::holds;
}

}  // namespace quoin
