// SPDX-FileCopyrightText: 2026 The Quoin authors
// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/loop_closing.hpp"

#include <utility>
#include <vector>

namespace quoin {
namespace {

constexpr std::size_t least_keyframes = 30;  // before a loop is looked for
constexpr std::size_t remembered = 20;       // keyframes
constexpr std::size_t budget = 3000;         // of LandmarkGraph::size in the steps of one scan

}  // namespace

void LoopClosing::work(const LandmarkGraph& graph, const KeyframePoints& clouds) {
  if (holds_) return;
  if (trial_) {
    go_on_trying();
  } else {
    search(graph, clouds);
  }
}

void LoopClosing::search(const LandmarkGraph& graph, const KeyframePoints& clouds) {
  const std::size_t now = graph.keyframes().size() - 1;
  if (now < least_keyframes || now < last_keyframe_ + 2) return;
  last_keyframe_ = now;
  const std::optional<LoopPlace> place = find_loop_place(graph);
  if (!place) return;
  const std::optional<LandmarkGraph::Edge> edge = find_loop(graph, clouds, *place);
  if (!edge) return;
  std::erase_if(found_, [&](const auto& other) { return other.to + remembered < now; });
  const std::vector<LandmarkGraph::Edge> agreeing = agreeing_edges(graph, found_, *edge);
  if (agreeing.empty()) {
    found_.push_back(*edge);
  } else {
    trial_.emplace(graph, agreeing, *edge);
  }
}

void LoopClosing::go_on_trying() {
  LoopTrial::Verdict verdict = LoopTrial::Verdict::open;
  std::size_t spent = 0;
  do {
    spent += trial_->graph().size();
    verdict = trial_->step();
  } while (verdict == LoopTrial::Verdict::open && spent < budget);
  if (verdict == LoopTrial::Verdict::holds) {
    holds_ = true;
  } else if (verdict == LoopTrial::Verdict::refuted) {
    found_.push_back(trial_->loop().back());
    trial_.reset();
  }
}

bool LoopClosing::close(LandmarkGraph& graph) {
  if (!holds_) return false;
  graph.take_solution(trial_->graph());
  for (const LandmarkGraph::Edge& edge : trial_->loop()) {
    graph.close_loop(edge.from, edge.to, edge.motion);
  }
  trial_.reset();
  holds_ = false;
  found_.clear();
  ++closed_;
  return true;
}

void LoopClosing::check(LandmarkGraph& graph) {
  for (std::size_t i = graph.edges().size(); i-- > 0;) {
    const LandmarkGraph::Edge& edge = graph.edges()[i];
    if (edge.closes_loop && graph.chi_square(edge) > 2.0 * loop_gate) {
      graph.drop_loop(i);
      --closed_;
      // What is tried stands on that loop.
      trial_.reset();
      holds_ = false;
    }
  }
}

}  // namespace quoin
