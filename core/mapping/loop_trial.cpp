// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_trial.hpp"

#include <algorithm>

namespace quoin {
namespace {

constexpr double loop_cost = 100.0;  // of what closes a loop, for each pair of keyframes
constexpr int steps_trusted = 6;
constexpr int steps_weighted = 3;  // and without the loop
constexpr double still = 1e-3;     // [m, rad] of every pose

}  // namespace

LoopTrial::LoopTrial(const LandmarkGraph& graph, std::span<const LandmarkGraph::Edge> agreeing,
                     const LandmarkGraph::Edge& edge)
    : graph_(graph), loop_(agreeing.begin(), agreeing.end()) {
  loop_.push_back(edge);
}

LoopTrial::Verdict LoopTrial::step() {
  const double cost = graph_.optimize(1, phase_ == Phase::trusted);
  if (phase_ == Phase::without) cost_before_ = cost;
  if (phase_ == Phase::trusted) cost_after_ = cost;
  ++steps_;
  const int most = phase_ == Phase::trusted ? steps_trusted : steps_weighted;
  if (steps_ < most && graph_.largest_change() > still) return Verdict::open;
  if (phase_ == Phase::weighted) return judge();
  end_phase();
  return Verdict::open;
}

void LoopTrial::end_phase() {
  steps_ = 0;
  if (phase_ == Phase::trusted) {
    phase_ = Phase::weighted;
    return;
  }
  phase_ = Phase::trusted;
  first_loop_ = graph_.edges().size();
  for (const LandmarkGraph::Edge& edge : loop_) graph_.close_loop(edge.from, edge.to, edge.motion);
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
