// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_closing.hpp"

#include <optional>
#include <utility>

#include "core/mapping/loop_trial.hpp"

namespace quoin {
namespace {

constexpr std::size_t least_keyframes = 30;  // before a loop is looked for
constexpr std::size_t remembered = 20;       // keyframes

}  // namespace

bool LoopClosing::close(LandmarkGraph& graph, const KeyframePoints& clouds) {
  const std::size_t now = graph.keyframes().size() - 1;
  if (now < least_keyframes || now < last_keyframe_ + 2) return false;
  last_keyframe_ = now;
  const std::optional<LoopPlace> place = find_loop_place(graph);
  if (!place) return false;
  const std::optional<LandmarkGraph::Edge> edge = find_loop(graph, clouds, *place);
  if (!edge) return false;
  std::erase_if(found_, [&](const auto& other) { return other.to + remembered < now; });
  const std::vector<LandmarkGraph::Edge> agreeing = agreeing_edges(graph, found_, *edge);
  if (!agreeing.empty()) {
    LoopTrial trial(graph, agreeing, *edge);
    LoopTrial::Verdict verdict = LoopTrial::Verdict::open;
    while (verdict == LoopTrial::Verdict::open) verdict = trial.step();
    if (verdict == LoopTrial::Verdict::holds) {
      graph = std::move(trial.graph());
      found_.clear();
      ++closed_;
      return true;
    }
  }
  found_.push_back(*edge);
  return false;
}

void LoopClosing::check(LandmarkGraph& graph) {
  for (std::size_t i = graph.edges().size(); i-- > 0;) {
    const LandmarkGraph::Edge& edge = graph.edges()[i];
    if (edge.closes_loop && graph.chi_square(edge) > 2.0 * loop_gate) {
      graph.drop_loop(i);
      --closed_;
    }
  }
}

}  // namespace quoin
